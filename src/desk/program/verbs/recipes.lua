--- The recipes of docs/cookbook.md, for `celspan help WORDS`.
--
--   ### A shadow on the ground            the title
--   *Words: shadow, cast shadow*          the words that it is found by
--   ```lua                                the script, whose first line has its name
--   -- cast_shadow.lua: three trees ...
--   ```                                   the lines after it say how it works
local page = ...

--- The sections of the page that have a title of the third level: title and lines each.
local function sections()
  local list, open = {}, nil
  for line in (page .. "\n"):gmatch "([^\n]*)\n" do
    local title = line:match "^### (.+)"
    if title then
      open = { title = title }
      list[#list + 1] = open
    elseif line:find "^## " then
      open = nil
    elseif open then
      open[#open + 1] = line
    end
  end
  return list
end

--- A section as a recipe. title, keywords, name, about: from its script; page: the whole section
--- without the picture; text: the text below the script.
local function recipe_of(section)
  local body = table.concat(section, "\n")
  local name, about = body:match "```lua\n%-%- ([%w_]+)%.lua: ([^\n]*)"
  local recipe = { title = section.title, keywords = { name }, name = name, about = about }
  for word in body:match "%*Words: (.-)%*":gsub("\n", " "):gmatch "%s*([^,]+)" do
    table.insert(recipe.keywords, word:lower())
  end
  recipe.text = body:match "\n```\n(.*)$"
  recipe.page = body:gsub("%*Words: .-%*\n+", ""):gsub("!%b[]%b()\n+", ""):gsub("\n```%l*", "\n")
    :gsub("%[([^%]]+)%]%b()", "%1"):gsub("\n\n\n+", "\n\n"):gsub("^\n+", ""):gsub("\n+$", "")
  return recipe
end

local recipes = {}
for i, section in ipairs(sections()) do recipes[i] = recipe_of(section) end
return recipes
