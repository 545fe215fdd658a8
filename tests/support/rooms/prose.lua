--- Looks for the phrases of rooms/phrases.lua in the prose of a tree.
local phrases = require "tests.support.rooms.phrases"
local prose_text = require "tests.support.rooms.prose_text"

local prose = {}

-- Files that are not read: the list of phrases would match itself, and inputs of fuzz targets are
-- data.
local LEFT_OUT = { "tests/support/rooms/phrases.lua", "tests/fuzz/corpus/" }
local PLACES = { "src", "lua", "scripts", "tests", "examples", "docs", "subprojects/spanfile",
                 "subprojects/planefile", "run", ".ci", "README.md", "CONTRIBUTING.md",
                 "CHANGELOG.md", "SECURITY.md", "meson_options.txt" }

-- ---------------------------------------------------------------- phrases

local function set_of(words)
  local set = {}
  for word in (words or ""):gmatch "[^|]+" do set[word] = true end
  return set
end

--- Phrases by each of their first words: { entry, words }, words[i] a set.
local function index_phrases()
  local index = {}
  for _, entry in ipairs(phrases.list) do
    for _, field in ipairs { "not_before", "not_after", "not_near" } do
      entry[field] = set_of(entry[field])
    end
    for _, phrase in ipairs(entry) do
      local one = { entry = entry, words = {} }
      for words in phrase:gmatch "%S+" do one.words[#one.words + 1] = set_of(words) end
      for word in pairs(one.words[1]) do
        index[word] = index[word] or {}
        table.insert(index[word], one)
      end
    end
  end
  return index
end

local INDEX = index_phrases()

-- ---------------------------------------------------------------- one file

--- The words of a text, with the beginning and the end of each.
local function split(text)
  local words = { first = {}, last = {}, text = text }
  for first, word, after in text:gmatch "()([%w_']+)()" do
    local n = #words + 1
    words[n], words.first[n], words.last[n] = word:lower(), first, after - 1
  end
  return words
end

--- Whether there are only blanks between word i and the next word.
local function is_followed(words, i)
  if i < 1 or i >= #words then return false end
  return not words.text:sub(words.last[i] + 1, words.first[i + 1] - 1):find "%S"
end

--- Whether a word of `set` is among the words after i, within the sentence.
local function is_near(words, i, set)
  for n = i + 1, math.min(i + phrases.NEAR, #words) do
    local between = words.text:sub(words.last[n - 1] + 1, words.first[n] - 1)
    if between:find "[.;:%z]" then return false end
    if set[words[n]] then return true end
  end
  return false
end

--- The last word of a phrase that begins at word i, or nothing.
local function match_end(words, i, phrase)
  local last = i + #phrase.words - 1
  for n = i, last do
    local is_next = n == i or is_followed(words, n - 1)
    if not (is_next and phrase.words[n - i + 1][words[n] or ""]) then return end
  end
  local entry = phrase.entry
  local next_word = is_followed(words, last) and words[last + 1]
  if next_word and (entry.at_end or entry.not_before[next_word]) then return end
  if is_followed(words, i - 1) and entry.not_after[words[i - 1]] then return end
  if next(entry.not_near) and is_near(words, last, entry.not_near) then return end
  return last
end

--- The exception for a phrase, the words from..to of a file.
local function find_exception(path, words, from, to)
  local first, last = words.first[math.max(1, from - 12)], words.last[math.min(#words, to + 12)]
  local around = words.text:sub(first, last):gsub("%s+", " ")
  local phrase = table.concat(words, " ", from, to)
  for _, one in ipairs(phrases.exceptions) do
    local is_there = path:find(one.place, 1, true) == 1 and around:find(one.text, 1, true)
    if is_there and one.text:lower():find(phrase, 1, true) then return one end
  end
end

local function line_of(text, at) return select(2, text:sub(1, at):gsub("\n", "")) + 1 end

--- Calls visit(line, words, entry) for each phrase in a file, unless it is of an unknown kind.
local function read(name, used, visit)
  local file = assert(io.open(name, "rb"))
  local text = file:read "a"
  file:close()
  local words = split(prose_text.of(text, name) or "")
  for i = 1, #words do
    for _, phrase in ipairs(INDEX[words[i]] or {}) do
      local last = match_end(words, i, phrase)
      local exception = last and find_exception(name, words, i, last)
      if exception then
        used[exception] = true
      elseif last then
        visit(line_of(text, words.first[i]), table.concat(words, " ", i, last), phrase.entry)
      end
    end
  end
end

-- ---------------------------------------------------------------- a tree

local function is_left_out(name)
  for _, beginning in ipairs(LEFT_OUT) do
    if name:sub(1, #beginning) == beginning then return true end
  end
  return false
end

--- The files in some places, each of which is a file or a folder.
local function files_of(places)
  local names = {}
  for _, place in ipairs(places) do
    local pipe = assert(io.popen(("find '%s' -type f 2>/dev/null"):format(place)))
    for name in pipe:lines() do
      name = name:gsub("^%./", "")
      if not is_left_out(name) then names[#names + 1] = name end
    end
    pipe:close()
  end
  table.sort(names)
  return names
end

--- Whether one of the files that were read lies in a place.
local function has_read(files, place)
  for _, name in ipairs(files) do
    if name:find(place, 1, true) == 1 then return true end
  end
  return false
end

local function unused_exceptions(used, files)
  local list = {}
  for _, exception in ipairs(phrases.exceptions) do
    if not used[exception] and has_read(files, exception.place) then list[#list + 1] = exception end
  end
  return list
end

--- Reports a file by fault(sentence), at most once, with a line for each of its phrases.
local function check_file(name, used, fault)
  local lines = {}
  read(name, used, function(line, found, entry)
    lines[#lines + 1] = ("%s:%d: %s: %s"):format(name, line, found, entry.say)
  end)
  if #lines > 0 then fault("%s", table.concat(lines, "\n")) end
end

--- Calls fault(format, ...) for each file with phrases in the places, or in the whole tree when
--- there are no places; returns the number of files.
function prose.check(places, fault)
  local names, used = files_of(#places > 0 and places or PLACES), {}
  for _, name in ipairs(names) do check_file(name, used, fault) end
  for _, one in ipairs(unused_exceptions(used, names)) do
    fault("%s: the exception \"%s\" is not needed", one.place, one.text)
  end
  return #names + #phrases.exceptions
end

return prose
