--- The search of `celspan help WORDS`, over entries: { title =, keywords = { text, ... }, text = }.
--
-- An entry that has the whole phrase, as a part of its title or as a keyword, comes before one that
-- has all of the words somewhere. Entries that have only some of them, in the title or in keywords,
-- are listed where there are no others. Within each of the three a word counts 3 in the title, 2 in
-- a keyword and 1 in the text, and of two entries that are equal the one whose title is the phrase
-- to the letter comes first ("keys" before "key"), then the one with the shorter title. The phrase
-- is searched for as it is, and with each synonym in it replaced, which counts a tenth less, or a
-- tenth more if it is the whole phrase and is_first. Words are compared by their stems. A word that
-- no entry has is read as the one with the nearest spelling.
local nearest, synonyms = ...

-- weights that are greater than any number of words in a query
local PHRASE, ALL, ANY = 30000, 20000, 10000
local TITLE, KEYWORD, TEXT = 3, 2, 1
local EXACT = 0.5
local SYNONYM, FIRST = 0.9, 1.1

local is_small = {} -- words that have no meaning for a search
for word in ("a an and as by do for how i in is it my of on or the to with"):gmatch "%a+" do
  is_small[word] = true
end

--- The stem of a word, without its endings: ease, eases, eased and easing have the same stem.
local function stem(word)
  local short = word:gsub("([^su])s$", "%1")
  short = short:gsub("^(...+)ing$", "%1"):gsub("^(...+)ed$", "%1")
  if short ~= word then short = short:gsub("([bdgmnprt])%1$", "%1") end
  return #short > 3 and short:gsub("e$", ""):gsub("y$", "i") or short
end

--- The words of a text in lower case, except small words.
local function words_of(text)
  local list = {}
  for word in text:lower():gmatch "[%w\128-\255]+" do
    if not is_small[word] then list[#list + 1] = word end
  end
  return list
end

local function stems_of(text)
  local list = words_of(text)
  for i, word in ipairs(list) do list[i] = stem(word) end
  return list
end

--- Stems as a text in which whole words can be found: " motion blur ".
local function line_of(stems) return " " .. table.concat(stems, " ") .. " " end

-- ---------------------------------------------------------------- an index

--- The parts of an entry that are searched. places: the weight of each stem; lines: its title and
--- keywords; length: of its title.
local function indexed(entry)
  local one = { entry = entry, places = {}, lines = {} }
  local function add(stems, points)
    for _, word in ipairs(stems) do one.places[word] = math.max(one.places[word] or 0, points) end
  end
  add(stems_of(entry.text or ""), TEXT)
  for _, keyword in ipairs(entry.keywords or {}) do
    local stems = stems_of(keyword)
    add(stems, KEYWORD)
    one.lines[#one.lines + 1] = line_of(stems)
  end
  local stems = stems_of(entry.title)
  add(stems, TITLE)
  one.title, one.length = line_of(stems), #stems
  one.said = line_of(words_of(entry.title))
  return one
end

--- All stems of an index, and the words of its titles and keywords, for finding the nearest
--- spelling.
local function vocabulary(index)
  local known, names = {}, {}
  local function add(text)
    for _, word in ipairs(words_of(text)) do
      if #word > 2 then names[#names + 1] = word end
    end
  end
  for _, one in ipairs(index) do
    for word in pairs(one.places) do known[word] = true end
    add(one.entry.title)
    for _, keyword in ipairs(one.entry.keywords or {}) do add(keyword) end
  end
  for _, row in ipairs(synonyms) do
    for _, word in ipairs(stems_of(row[1])) do known[word] = true end
    add(row[1])
  end
  return known, names
end

-- ---------------------------------------------------------------- queries

--- The stems of a query. An unknown word is replaced by the nearest known word with the same first
--- letter.
local function query_of(text, known, names)
  local list = words_of(text)
  for i, word in ipairs(list) do
    local near = not known[stem(word)] and nearest(word, names)
    list[i] = stem(near and near:sub(1, 1) == word:sub(1, 1) and near or word)
  end
  return list
end

--- The query itself, and the query with one of its phrases replaced: { stems =, said =, weight = }
--- each.
local function alternatives(query, text)
  local line = line_of(query)
  local list = { { stems = query, said = line_of(words_of(text)), weight = 1 } }
  for _, row in ipairs(synonyms) do
    local from, to = line:find(line_of(stems_of(row[1])), 1, true)
    local is_first = row.is_first and line == line_of(stems_of(row[1]))
      and text:lower():find(row[1], 1, true)
    for i = 2, from and #row or 0 do
      local replaced = line:sub(1, from) .. row[i] .. line:sub(to)
      list[#list + 1] = { stems = stems_of(replaced), said = line_of(words_of(replaced)),
                          weight = is_first and FIRST or SYNONYM }
    end
  end
  return list
end

-- ---------------------------------------------------------------- points

local function has_phrase(one, line)
  if one.title:find(line, 1, true) then return true end
  for _, keyword in ipairs(one.lines) do
    if keyword == line then return true end
  end
  return false
end

--- The points of an entry; 0: it contains nothing of the query.
local function points_of(one, query)
  local stems = query.stems
  local sum, found, best = 0, 0, 0
  for _, word in ipairs(stems) do
    local points = one.places[word] or 0
    sum, best = sum + points, math.max(best, points)
    if points > 0 then found = found + 1 end
  end
  if found == 0 then return 0 end
  if has_phrase(one, line_of(stems)) then
    return PHRASE + sum + (one.said == query.said and EXACT or 0)
  end
  if found == #stems then return ALL + sum end
  return best > TEXT and ANY + sum or 0
end

--- The highest points that an entry gets for one of the alternatives.
local function best_of(one, queries)
  local best = 0
  for _, query in ipairs(queries) do
    best = math.max(best, query.weight * points_of(one, query))
  end
  return best
end

--- The entries that match a text best, at most `most` of them.
return function(entries, text, most)
  local index, found = {}, {}
  for i, entry in ipairs(entries) do index[i] = indexed(entry) end
  local queries = alternatives(query_of(text, vocabulary(index)), text)
  for i, one in ipairs(index) do
    one.points, one.order = best_of(one, queries), i
    if one.points > 0 then found[#found + 1] = one end
  end
  table.sort(found, function(a, b)
    if a.points ~= b.points then return a.points > b.points end
    if a.length ~= b.length then return a.length < b.length end
    return a.order < b.order
  end)
  local list = {}
  for i = 1, math.min(#found, most) do
    local has_all = found[i].points >= SYNONYM * ALL
    if has_all or found[1].points < SYNONYM * ALL then list[i] = found[i].entry end
  end
  return list
end
