--- The recipes of docs/cookbook.md, for `celspan help WORD`.
--
--   ### A shadow on the ground        the title
--   *Words: shadow, cast shadow*      the words that it is found by
--   ```lua ... ```                    the script; the lines after it say how it works
local page = ...

local recipes = {}

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

--- Every recipe: title, words (a list), text, without the picture, in the order of the page.
local function read()
  local list = {}
  for i, section in ipairs(sections()) do
    local words, body = {}, table.concat(section, "\n")
    for word in body:match "%*Words: (.-)%*":gsub("\n", " "):gmatch "%s*([^,]+)" do
      words[#words + 1] = word:lower()
    end
    local text = body:gsub("%*Words: .-%*\n+", ""):gsub("!%b[]%b()\n+", ""):gsub("\n```%l*", "\n")
      :gsub("%[([^%]]+)%]%b()", "%1"):gsub("\n\n\n+", "\n\n"):gsub("^\n+", ""):gsub("\n+$", "")
    list[i] = { title = section.title, words = words, text = text }
  end
  return list
end

--- How well a recipe goes with a word: 3 it is one of its words, 2 it is in one of them, 1 it is in
--- the title; 0 not at all.
local function score(recipe, word)
  local best = recipe.title:lower():find(word, 1, true) and 1 or 0
  for _, known in ipairs(recipe.words) do
    if known == word then return 3 end
    if (" " .. known .. " "):find(" " .. word .. " ", 1, true) then best = 2 end
  end
  return best
end

--- The recipes that go best with a word, and all of them in the order of the page.
function recipes.find(word)
  local best, found, all = 1, {}, read()
  word = word:lower()
  for _, recipe in ipairs(all) do
    local points = score(recipe, word)
    if points > best then best, found = points, {} end
    if points == best then found[#found + 1] = recipe end
  end
  return found, all
end

return recipes
