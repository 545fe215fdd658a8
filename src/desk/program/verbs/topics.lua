--- The entries that `celspan help WORDS` searches: recipes, headings of pages, names of the Lua
--- interface, and verbs; each is { title =, keywords =, text =, about =, read = }. about: a
--- sentence; read: the command or the place with more information.
local recipes, headings, names, verbs = ...

local topics, is_verb = {}, {}

local function add(topic) topics[#topics + 1] = topic end

--- A text of Markdown as plain text.
local function plain(text) return (text:gsub("%[([^%]]+)%]%b()", "%1"):gsub("[`*]", "")) end

local function first_sentence(text)
  local sentence = text:match '^(.-[%w)"][.!?])%f[%z ]' or text
  return (sentence:gsub(":$", "."))
end

for _, recipe in ipairs(recipes) do
  add { title = recipe.title, keywords = recipe.keywords, text = recipe.about .. recipe.text,
        about = recipe.about, read = "celspan help " .. recipe.name }
end

for _, verb in ipairs(verbs) do is_verb[verb.name] = true end

for page, heading, text in headings:gmatch "\n([^\t\n]*)\t([^\t]*)\t([^\n]*)" do
  local is_name = page:find "^lua" and heading:find "^[%l]+[.:]" or heading:find "^Module "
  if not is_name and not (page == "command-line.md" and is_verb[heading]) then
    text = plain(text)
    local title = plain(heading) .. (page == "c.md" and not heading:find "^C " and " in C" or "")
    add { title = title, text = text, about = first_sentence(text),
          read = ('docs/%s, "%s"'):format(page, plain(heading)) }
  end
end

for _, name in ipairs(names) do
  add { title = name[1], text = name[2], about = name[2], read = "celspan help lua " .. name[1] }
end

for _, verb in ipairs(verbs) do
  local text = verb.summary .. " " .. (verb.notes or "")
  for _, option in ipairs(verb.options) do text = text .. " " .. option.name end
  add { title = verb.name, text = text, about = verb.summary, read = "celspan help " .. verb.name }
end

return topics
