-- The corpus of tests/fuzz/fuzz_text.c: a small part of the font that ships under several texts.
--
--   lua5.4 tests/fuzz/make_text_corpus.lua tests/fuzz/corpus/text
package.path = "./?.lua;" .. package.path
local block = require "tests.support.block"
local truetype = require "tests.support.truetype"

local folder = assert(..., "usage: lua5.4 tests/fuzz/make_text_corpus.lua FOLDER")

--- The font with the glyphs of few characters, "->" and its ligature among them.
local function small(is_variable)
  local font, kept, number = block.font(), {}, {}
  for i, glyph in ipairs(font.glyphs) do
    local character = glyph.characters[1]
    if i == 1 or ("AVIi. ->→ שלו"):find(utf8.char(character or 0), 1, true)
      or character == 0x301 then
      kept[#kept + 1] = glyph
      number[i] = #kept
    end
  end
  local function renumbered(list, count)
    local made = {}
    for _, one in ipairs(list) do
      local copy = table.move(one, 1, #one, 1, {})
      local is_there = true
      for i = 1, count or #one do
        copy[i] = number[one[i]]
        is_there = is_there and copy[i] ~= nil
      end
      if is_there then made[#made + 1] = copy end
    end
    return made
  end
  font.glyphs = kept
  font.kerning, font.ligatures = renumbered(font.kerning, 2), renumbered(font.ligatures)
  if not is_variable then font.axis = nil end
  return truetype.build(font)
end

local cases = {
  plain = { 0, "AVI." }, wrapped = { 1 + 64, "AVI AVI AVI AVI AVI AVI." },
  hebrew = { 2, "AV שלו I." }, variable = { 4 + 32, "A->V" }, features = { 8 + 16, "->i\u{301}" },
  lines = { 1, "A\n\nV I\r\nA" }, hidden = { 1, "AV\u{ad}AV\u{ad}AV\u{200b}I" },
  nothing = { 0, "" },
  unknown = { 32, "AжV" }, broken = { 0, "A\xff" },
}
for name, case in pairs(cases) do
  local file = assert(io.open(folder .. "/" .. name, "wb"))
  file:write(string.char(case[1], #case[2]), case[2], small(case[1] & 4 > 0))
  file:close()
end
