-- Print for the last level: letters of five by seven squares.
local draw = require "terapixel.draw"

local print = {}

--- Seven rows of five bits per letter, from the top.
local letters = {
  A = "0EHHVHHH", B = "UHHUHHU", C = "EHGGGHE", D = "UHHHHHU", E = "VGGUGGV", F = "VGGUGGG",
  G = "EHGNHHE", H = "HHHVHHH", I = "E44444E", J = "72222IC", K = "HIKOKIH", L = "GGGGGGV",
  M = "HRLLHHH", N = "HPLJHHH", O = "EHHHHHE", P = "UHHUGGG", Q = "EHHHLID", R = "UHHUKIH",
  S = "FGGE11U", T = "V444444", U = "HHHHHHE", V = "HHHHHA4", W = "HHHLLRH", X = "HHA4AHH",
  Y = "HHA4444", Z = "V1248GV", ["0"] = "EHJLPHE", ["1"] = "4C4444E", ["2"] = "EH1248V",
  ["3"] = "V1261HE", ["4"] = "26AIV22", ["5"] = "VGU11HE", ["6"] = "68GUHHE", ["7"] = "V124888",
  ["8"] = "EHHEHHE", ["9"] = "EHHF12C", ["."] = "00000CC", [","] = "00000C8", [":"] = "0CC0CC0",
  ["-"] = "000V000", ["!"] = "4444404", ["'"] = "4480000",
}
letters.A = "4AHHVHH"

local digits = "0123456789ABCDEFGHIJKLMNOPQRSTUV"

--- Appends the squares of a letter; a run of squares in a row is one rectangle.
local function squares(list, letter, x, y, side)
  local rows = letters[letter]
  for row = 1, rows and 7 or 0 do
    local bits, column = digits:find(rows:sub(row, row), 1, true) - 1, 0
    while column < 5 do
      local width = 0
      while column + width < 5 and bits & (16 >> (column + width)) ~= 0 do width = width + 1 end
      if width > 0 then
        list[#list + 1] = { x + column * side, y + (row - 1) * side, width * side, side }
      end
      column = column + width + 1
    end
  end
end

--- Lines of text, with letters six squares wide and lines ten high, as one mark.
function print.text(x, y, side, texture, lines)
  local list = {}
  for i, line in ipairs(lines) do
    for k = 1, #line do
      squares(list, line:sub(k, k), x + (k - 1) * 6 * side, y + (i - 1) * 10 * side, side)
    end
  end
  return draw.rects(texture, list)
end

return print
