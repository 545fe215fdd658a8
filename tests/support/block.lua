--- The font of the scripts and tests, drawn with a round pen: capitals, small capitals, both with
--- the accents of European languages, digits, signs, and a few letters of other scripts, in any
--- weight from 200 to 900.
---
---   lua5.4 tests/support/block.lua OUT.ttf      scripts/type/block.ttf is what it makes
---
--- Letters are lines and arcs, each a contour of its own that overlaps its neighbours: they need
--- the non-zero rule, as the letters of most variable fonts do.
package.path = "./?.lua;" .. package.path
local truetype = require "tests.support.truetype"

-- ---------------------------------------------------------------- letters
-- Positions of the pen, from the left end and the baseline. "L": points joined by lines. "A":
-- centre, radius, and two angles in degrees, counted counterclockwise from the right.

local W = { -- name: how far the pen moves to the right, then its movements
  A = { 460, "L 0 0 230 612 460 0", "L 71 190 389 190" },
  B = { 380, "L 227 0 0 0 0 612 207 612", "L 0 306 227 306", "A 207 459 153 -90 90",
    "A 227 153 153 -90 90" },
  C = { 450, "A 230 382 230 20 180", "L 0 382 0 230", "A 230 230 230 180 340" },
  D = { 440, "L 194 0 0 0 0 612 194 612", "A 194 366 246 0 90", "L 440 366 440 246",
    "A 194 246 246 -90 0" },
  E = { 350, "L 350 0 0 0 0 612 350 612", "L 0 306 300 306" },
  F = { 340, "L 0 0 0 612 340 612", "L 0 306 290 306" },
  G = { 460, "A 230 382 230 25 180", "L 0 382 0 230", "A 230 230 230 180 360",
    "L 460 230 460 290 280 290" },
  H = { 440, "L 0 0 0 612", "L 440 0 440 612", "L 0 306 440 306" },
  I = { 0, "L 0 0 0 612" },
  J = { 340, "L 340 612 340 170", "A 170 170 170 180 360" },
  K = { 420, "L 0 0 0 612", "L 0 230 400 612", "L 140 364 420 0" },
  L = { 340, "L 0 612 0 0 340 0" },
  M = { 540, "L 0 0 0 612 270 200 540 612 540 0" },
  N = { 440, "L 0 0 0 612 440 0 440 612" },
  O = { 500, "A 250 362 250 0 180", "L 0 362 0 250", "A 250 250 250 180 360", "L 500 250 500 362" },
  P = { 390, "L 0 0 0 612 226 612", "A 226 448 164 -90 90", "L 0 284 226 284" },
  Q = { 500, "A 250 362 250 0 180", "L 0 362 0 250", "A 250 250 250 180 360", "L 500 250 500 362",
    "L 330 130 500 -40" },
  R = { 400, "L 0 0 0 612 226 612", "A 226 448 164 -90 90", "L 0 284 226 284", "L 210 284 400 0" },
  S = { 400, "L 380 612 153 612", "A 153 459 153 90 270", "L 153 306 247 306",
    "A 247 153 153 -90 90", "L 247 0 0 0" },
  T = { 460, "L 0 612 460 612", "L 230 612 230 0" },
  U = { 440, "L 0 612 0 220", "A 220 220 220 180 360", "L 440 220 440 612" },
  V = { 460, "L 0 612 230 0 460 612" },
  W = { 640, "L 0 612 160 0 320 520 480 0 640 612" },
  X = { 440, "L 0 0 440 612", "L 0 612 440 0" },
  Y = { 440, "L 0 612 220 290 440 612", "L 220 290 220 0" },
  Z = { 420, "L 0 612 420 612 0 0 420 0" },
}

local signs = {
  { "0", 380, "A 190 422 190 0 180", "L 0 422 0 190", "A 190 190 190 180 360",
    "L 380 190 380 422" },
  { "1", 170, "L 0 492 170 612 170 0" },
  { "2", 380, "A 190 422 190 -40 165", "L 336 300 0 0 380 0" },
  { "3", 360, "A 207 459 153 -90 140", "L 150 306 207 306", "A 207 153 153 -140 90" },
  { "4", 420, "L 300 0 300 612 0 180 420 180" },
  { "5", 380, "L 340 612 60 612 51 353", "A 180 200 200 -140 130" },
  { "6", 380, "A 190 190 190 0 360", "L 20 270 230 612" },
  { "7", 400, "L 0 612 400 612 130 0" },
  { "8", 306, "A 153 459 153 0 360", "A 153 153 153 0 360" },
  { "9", 380, "A 190 422 190 0 360", "L 360 342 150 0" },
  { ".", 0, "L 0 0 0 0" }, { ",", 40, "L 40 10 0 -110" },
  { ":", 0, "L 0 0 0 0", "L 0 330 0 330" }, { ";", 40, "L 40 10 0 -110", "L 40 330 40 330" },
  { "!", 0, "L 0 612 0 190", "L 0 0 0 0" },
  { "?", 330, "A 165 447 165 -90 170", "L 165 282 165 190", "L 165 0 165 0" },
  { "-", 220, "L 0 280 220 280" }, { "–", 400, "L 0 280 400 280" },
  { "—", 640, "L 0 280 640 280" }, { "·", 0, "L 0 290 0 290" },
  { "'", 0, "L 0 612 0 500" }, { "’", 30, "L 30 620 0 500" },
  { "\"", 110, "L 0 612 0 500", "L 110 612 110 500" },
  { "(", 134, "A 420 306 420 133 227" }, { ")", 134, "A -286 306 420 -47 47" },
  { "/", 300, "L 0 -40 300 650" }, { "+", 400, "L 0 306 400 306", "L 200 106 200 506" },
  { "=", 400, "L 0 206 400 206", "L 0 406 400 406" }, { ">", 260, "L 0 106 260 306 0 506" },
  { "…", 360, "L 0 0 0 0", "L 180 0 180 0", "L 360 0 360 0" },
  { "→", 560, "L 0 306 560 306", "L 400 150 560 306 400 462" },
  { "ש", 440, "L 0 500 60 0 300 0", "A 300 140 140 -90 0", "L 440 140 440 500", "L 210 500 190 0" },
  { "ל", 300, "L 0 700 0 500 300 500 300 300 80 0" }, { "ו", 60, "L 0 500 60 500 60 0" },
  { "ם", 340, "L 0 500 340 500 340 0 40 0 40 500" },
  { "א", 380, "L 0 500 380 0", "L 360 500 280 180", "L 30 0 110 320" },
  { "一", 760, "L 0 320 760 320" }, { "二", 760, "L 90 500 670 500", "L 0 80 760 80" },
  { "三", 760, "L 60 600 700 600", "L 120 340 640 340", "L 0 60 760 60" },
  { "。", 120, "A 60 40 60 0 360" },
}

local more_signs = {
  { "%", 490, "L 410 612 80 0", "A 90 500 90 0 360", "A 400 112 90 0 360" },
  { "&", 440, "A 175 472 140 -40 225", "L 76 373 440 0", "L 282 382 54 291",
    "A 160 165 165 130 340", "L 315 109 440 270" },
  { "@", 600, "A 300 290 300 0 305", "L 600 290 600 220", "A 520 220 80 180 360",
    "A 285 290 155 0 360", "L 440 440 440 220" },
  { "€", 460, "A 270 382 230 30 180", "L 40 382 40 230", "A 270 230 230 180 330",
    "L -20 376 300 376", "L -20 236 300 236" },
  { "$", 400, "L 380 612 153 612", "A 153 459 153 90 270", "L 153 306 247 306",
    "A 247 153 153 -90 90", "L 247 0 0 0", "L 200 612 200 710", "L 200 0 200 -98" },
  { "£", 400, "L 0 0 390 0", "L 110 0 110 462", "A 260 462 150 20 180", "L 0 290 290 290" },
  { "¥", 440, "L 0 612 220 290 440 612", "L 220 290 220 0", "L 50 250 390 250",
    "L 50 100 390 100" },
  { "¢", 340, "A 200 276 200 45 315", "L 200 476 200 580", "L 200 76 200 -28" },
  { "#", 440, "L 160 612 110 0", "L 340 612 290 0", "L 0 410 440 410", "L 0 190 440 190" },
  { "*", 242, "L 121 612 121 332", "L 0 542 242 402", "L 0 402 242 542" },
  { "[", 120, "L 120 650 0 650 0 -40 120 -40" }, { "]", 120, "L 0 650 120 650 120 -40 0 -40" },
  { "{", 160, "L 160 650 120 650 75 605 75 360 0 305 75 250 75 5 120 -40 160 -40" },
  { "}", 160, "L 0 650 40 650 85 605 85 360 160 305 85 250 85 5 40 -40 0 -40" },
  { "<", 260, "L 260 106 0 306 260 506" }, { "\\", 300, "L 300 -40 0 650" },
  { "|", 0, "L 0 690 0 -80" }, { "_", 440, "L 0 -70 440 -70" },
  { "^", 260, "L 0 480 130 612 260 480" }, { "`", 70, "L 0 612 70 520" },
  { "~", 400, "A 100 236 140 45 135", "A 300 436 140 225 315" },
  { "‘", 30, "L 0 620 30 500" }, { "“", 150, "L 0 620 30 500", "L 120 620 150 500" },
  { "”", 150, "L 30 620 0 500", "L 150 620 120 500" }, { "‚", 40, "L 40 10 0 -110" },
  { "„", 170, "L 40 10 0 -110", "L 170 10 130 -110" },
  { "‹", 130, "L 130 160 0 306 130 452" }, { "›", 130, "L 0 160 130 306 0 452" },
  { "«", 290, "L 130 160 0 306 130 452", "L 290 160 160 306 290 452" },
  { "»", 290, "L 0 160 130 306 0 452", "L 160 160 290 306 160 452" },
  { "¿", 330, "A 165 165 165 90 350", "L 165 330 165 422", "L 165 612 165 612" },
  { "¡", 0, "L 0 0 0 422", "L 0 612 0 612" },
  { "×", 320, "L 0 146 320 466", "L 0 466 320 146" }, { "−", 400, "L 0 306 400 306" },
  { "÷", 400, "L 0 306 400 306", "L 200 500 200 500", "L 200 112 200 112" },
  { "±", 400, "L 0 366 400 366", "L 200 186 200 546", "L 0 0 400 0" },
  { "°", 156, "A 78 534 78 0 360" }, { "•", 70, "L 0 306 70 306", "L 35 271 35 341" },
  { "©", 600, "A 300 306 300 0 360", "A 300 306 130 50 310" },
  { "²", 200, "A 100 512 100 -30 165", "L 187 462 0 290 200 290" },
  { "³", 190, "A 100 532 80 -90 150", "A 100 372 80 -150 90" },
  { "←", 560, "L 0 306 560 306", "L 160 150 0 306 160 462" },
  { "↑", 312, "L 156 0 156 612", "L 0 452 156 612 312 452" },
  { "↓", 312, "L 156 0 156 612", "L 0 160 156 0 312 160" },
  { "✓", 440, "L 0 280 150 110 440 560" },
}

-- Letters of their own: the capital, the small letter, how far the pen moves, its movements.
local own_letters = {
  { "Æ", "æ", 640, "L 0 0 290 612 640 612", "L 90 190 320 190", "L 320 612 320 0 640 0",
    "L 320 306 590 306" },
  { "Œ", "œ", 720, "A 250 362 250 90 180", "L 0 362 0 250", "A 250 250 250 180 270",
    "L 250 612 720 612", "L 250 0 720 0", "L 390 0 390 612", "L 390 306 660 306" },
  { "Ø", "ø", 500, "A 250 362 250 0 180", "L 0 362 0 250", "A 250 250 250 180 360",
    "L 500 250 500 362", "L 20 -30 480 642" },
  { "Ł", "ł", 380, "L 40 612 40 0 380 0", "L -40 230 190 390" },
  { "Ð", "ð", 440, "L 194 0 0 0 0 612 194 612", "A 194 366 246 0 90", "L 440 366 440 246",
    "A 194 246 246 -90 0", "L -90 306 170 306" },
  { "Þ", "þ", 390, "L 0 0 0 612", "A 226 306 164 -90 90", "L 0 142 226 142", "L 0 470 226 470" },
  { "ẞ", "ß", 395, "L 0 0 0 440", "A 172 440 172 35 180", "L 313 539 190 350 220 350",
    "A 220 175 175 -90 90", "L 220 0 140 0" },
}

-- Accents, from the middle of their lower end: the movements, and the letters that bear them.
local accents = {
  { "L -35 0 50 70", "AÁá CĆć EÉé IÍí LĹĺ NŃń OÓó RŔŕ SŚś UÚú YÝý ZŹź" },
  { "L 35 0 -50 70", "AÀà EÈè IÌì OÒò UÙù" },
  { "L -85 0 0 65 85 0", "AÂâ EÊê IÎî OÔô UÛû WŴŵ YŶŷ" },
  { "L -85 65 0 0 85 65", "CČč DĎď EĚě NŇň RŘř SŠš TŤť ZŽž" },
  { "L -85 25 -85 25", "L 85 25 85 25", "AÄä EËë IÏï OÖö UÜü YŸÿ" },
  { "A -55 -60 90 52 128", "A 55 82 90 232 308", "AÃã NÑñ OÕõ" },
  { "L -90 25 90 25", "AĀā EĒē IĪī OŌō UŪū" },
  { "L -95 0 -40 70", "L 45 0 100 70", "OŐő UŰű" },
  { "A 0 80 80 200 340", "AĂă GĞğ" },
  { "L 0 25 0 25", "CĊċ EĖė GĠġ ZŻż" },
  { "A 0 35 68 0 360", "AÅå UŮů" },
  { "L 10 0 -35 -115", "CÇç SŞş TŢţ", is_below = true },
  { "L 0 0 -45 -80 30 -120", "AĄą EĘę", is_below = true, at = 1 },
}

local kerning = { { "A", "T", -70 }, { "A", "V", -90 }, { "A", "Y", -90 }, { "F", "A", -60 },
  { "L", "T", -80 }, { "L", "V", -80 }, { "L", "Y", -80 }, { "P", "A", -80 }, { "T", "A", -70 },
  { "V", "A", -90 }, { "Y", "A", -90 } }

-- ---------------------------------------------------------------- the pen

local LEFT, BASE, SMALL = 90, 44, 0.76
--- Half of the pen's width, by weight.
local pens = { least = 22, contours = 44, most = 74 }

local function rounded(x) return math.floor(x + 0.5) end

--- A point at an angle from a centre.
local function around(contour, x, y, radius, degrees, is_on)
  local angle = math.rad(degrees)
  contour[#contour + 1] = { rounded(x + radius * math.cos(angle)),
    rounded(y + radius * math.sin(angle)), is_on }
end

--- The points of an arc after its first one.
local function sweep(contour, x, y, radius, from, to)
  local count = math.ceil(math.abs(to - from) / 45)
  local step = (to - from) / count
  for i = 1, count do
    around(contour, x, y, radius / math.cos(math.rad(step / 2)), from + step * (i - 0.5), false)
    around(contour, x, y, radius, from + step * i, true)
  end
end

--- A line with round ends, clockwise.
local function capsule(x0, y0, x1, y1, half)
  local degrees = math.deg(math.atan(y1 - y0, x1 - x0))
  local contour = {}
  around(contour, x0, y0, half, degrees + 90, true)
  around(contour, x1, y1, half, degrees + 90, true)
  sweep(contour, x1, y1, half, degrees + 90, degrees - 90)
  around(contour, x0, y0, half, degrees - 90, true)
  sweep(contour, x0, y0, half, degrees - 90, degrees - 270)
  contour[#contour] = nil -- the first point again
  return contour
end

--- An arc with round ends, clockwise.
local function arc(x, y, radius, low, high, half)
  local contour = {}
  local function ending(degrees) -- the position of the pen
    return x + radius * math.cos(math.rad(degrees)), y + radius * math.sin(math.rad(degrees))
  end
  around(contour, x, y, radius + half, high, true)
  sweep(contour, x, y, radius + half, high, low)
  local px, py = ending(low)
  sweep(contour, px, py, half, low, low - 180)
  sweep(contour, x, y, radius - half, low, high)
  px, py = ending(high)
  sweep(contour, px, py, half, high + 180, high)
  contour[#contour] = nil
  return contour
end

local function draw(movements, half, scale)
  local contours = {}
  local function add(contour) contours[#contours + 1] = contour end
  for i = 2, #movements do
    local n = {}
    for number in movements[i]:gmatch "%-?%d+" do n[#n + 1] = tonumber(number) end
    if movements[i]:sub(1, 1) == "A" then
      add(arc(LEFT + scale * n[1], BASE + scale * n[2], scale * n[3], n[4], n[5], half))
    else
      for k = 1, #n - 3, 2 do
        add(capsule(LEFT + scale * n[k], BASE + scale * n[k + 1], LEFT + scale * n[k + 2],
          BASE + scale * n[k + 3], half))
      end
    end
  end
  return contours
end

-- ---------------------------------------------------------------- the font

local block = {}

--- How an accent lies on a letter: to the right, and up.
local function place_of(accent, base, scale)
  local gap = accent[1]:find "^A 0 35" and base == "A" and 64 or 140 -- the ring of Å touches it
  return rounded(scale * W[base][1] * (accent.at or 0.5)),
    accent.is_below and 0 or rounded(scale * 612 + gap)
end

--- Adds the letters with an accent, each made of two glyphs. number: of the glyphs, by name; add:
--- adds a glyph of movements, and returns its number.
local function add_accents(glyphs, number, add)
  for i, accent in ipairs(accents) do
    local movements = table.move(accent, 1, #accent - 1, 2, { -2 * LEFT })
    local mark = add("accent " .. i, {}, movements, 1)
    for base, capital, small in accent[#accent]:gmatch "(%a)([\xc0-\xff][\x80-\xbf])(%S+)" do
      for k, character in ipairs { capital, small } do
        local letter = number[k == 1 and base or base:lower()]
        local x, y = place_of(accent, base, k == 1 and 1 or SMALL)
        local wide = base == "I" and 60 or 0
        glyphs[#glyphs + 1] = { characters = { utf8.codepoint(character) },
          advance = glyphs[letter].advance + 2 * wide,
          components = { { letter, wide, 0 }, { mark, x + wide, y } } }
      end
    end
  end
end

--- The description that truetype.build takes.
function block.font()
  local glyphs, number = {}, {}
  local function add(name, characters, movements, scale)
    local glyph = { characters = characters,
      advance = rounded(2 * LEFT + scale * movements[1]) }
    for field, half in pairs(pens) do glyph[field] = draw(movements, half, scale) end
    glyphs[#glyphs + 1] = glyph
    number[name] = #glyphs
    return #glyphs
  end
  add("none", {}, { 340, "L 0 0 340 0 340 612 0 612 0 0" }, 1)
  add("space", { 0x20, 0xa0 }, { 160 }, 1)
  for letter in ("ABCDEFGHIJKLMNOPQRSTUVWXYZ"):gmatch "." do
    add(letter, { letter:byte() }, W[letter], 1)
    add(letter:lower(), { letter:lower():byte() }, W[letter], SMALL)
  end
  for _, sign in ipairs(signs) do
    add(sign[1], { utf8.codepoint(sign[1]) }, table.move(sign, 2, #sign, 1, {}), 1)
  end
  add("acute", { 0x301 }, { -140, "L -300 660 -220 740" }, 1) -- a mark: it has no advance
  for _, sign in ipairs(more_signs) do
    add(sign[1], { utf8.codepoint(sign[1]) }, table.move(sign, 2, #sign, 1, {}), 1)
  end
  for _, letter in ipairs(own_letters) do
    local movements = table.move(letter, 3, #letter, 1, {})
    add(letter[1], { utf8.codepoint(letter[1]) }, movements, 1)
    add(letter[2], { utf8.codepoint(letter[2]) }, movements, SMALL)
  end
  add_accents(glyphs, number, add)
  local pairs_of = {}
  for i, one in ipairs(kerning) do pairs_of[i] = { number[one[1]], number[one[2]], one[3] } end
  table.sort(pairs_of, function(a, b)
    return a[1] < b[1] or a[1] == b[1] and a[2] < b[2]
  end)
  return { name = "Celspan Block", units = 1000, ascent = 900, descent = -200, cap_height = 700,
    x_height = 553, glyphs = glyphs,
    kerning = pairs_of, ligatures = { { number["-"], number[">"], number["→"] } },
    axis = { tag = "wght", name = "Weight", least = 200, default = 400, most = 900 } }
end

--- Writes the font, or what a test made of it, into a file.
function block.write(path, bytes)
  local file = assert(io.open(path, "wb"))
  assert(file:write(bytes or truetype.build(block.font())))
  assert(file:close())
end

if arg and arg[0] and arg[0]:match "tests/support/block%.lua$" then block.write(assert(arg[1])) end

return block
