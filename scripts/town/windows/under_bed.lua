-- The monster under the bed reads too; a hand from above pats it.
local gouache = require "town.gouache"
local window = require "town.window"
local mood = require("stage.moods").storm
local wash, form, line = gouache.wash, gouache.form, gouache.line

local FUR = radial { centre = { 225, 540 }, radius = 260, "#b9b06a", "#6b8468", "#3f5a55",
  "#2b4044" }

local room = union {
  gouache.wall(225, 560, 520, "#5f6a52", "#37464a", "#232e32", "#1b2428"),
  form(wash(0, 0, 450, 0, mood.near, "#5a6a6b"), "M0 0 H450 V292 H0 Z"),
  form("#45565c", "M40 150 H140 V232 H40 Z"), form("#84918a", "M48 158 H132 V224 H48 Z"),
  form("#45565c", "M90 168 L96 186 L114 186 L100 198 L106 216 L90 204 L74 216 L80 198 L66 186 "
    .. "L84 186 Z"),
}
local bed = union {
  form(wash(150, 0, 450, 0, "#dfe6cf", "#84918a"), "M250 272 C262 228 380 222 420 262 L424 300 "
    .. "H250 Z"),
  form(wash(0, 200, 0, 340, "#a3674c", "#6b4436"), "M0 262 C80 214 190 226 270 262 L300 330 "
    .. "C280 352 256 352 240 334 C222 354 194 354 180 336 C160 356 134 354 120 336 "
    .. "C100 356 74 354 60 336 C40 352 20 350 0 340 Z"),
  form(wash(0, 290, 0, 330, "#6b4a2e", "#3a2f28"), "M288 292 H450 V330 H300 Z"),
  form("#3a2f28", "M420 320 H446 V600 H420 Z M6 344 H30 V600 H6 Z"),
}
local body = form(nil, "M60 620 C40 520 60 440 110 404 C104 384 108 368 118 356 "
  .. "C134 362 146 376 150 388 C196 372 256 372 300 388 C304 376 316 362 332 356 "
  .. "C342 368 346 384 340 404 C392 440 410 520 390 620 Z"):paint(FUR)
  | form("#dfe6cf", "M166 384 C160 366 168 348 182 344 C182 358 188 370 194 378 Z M284 384 "
  .. "C290 366 282 348 268 344 C268 358 262 370 256 378 Z")
local tufts = line("M96 500 l10 16 l10 -14 M334 500 l10 16 l10 -14 M120 440 l8 14 l8 -12 "
  .. "M314 440 l8 14 l8 -12",
  5, "#2b4044")
local book = form(mood.accent, "M104 512 L222 534 V620 H104 Z M346 512 L228 534 V620 H346 Z")
  | form("#a3761c", "M218 532 H232 V620 H218 Z") | form("#a3761c", "M140 548 L196 558 V572 "
  .. "L140 562 Z")
local paws = form("#8f9c68", "M86 560 C80 534 112 524 126 546 C134 566 118 590 100 586 Z")
paws = paws | paws:scale(-1, 1, 225, 0)

local function eyes(look, shut)
  if shut then return line("M146 452 Q176 424 206 452 M244 452 Q274 424 304 452", 6, mood.ink) end
  local shown = union {}
  for _, x in ipairs { 176, 274 } do
    shown = shown | circle { x, 446, 35, fill = "#f1f0da" }
      | circle { 0, 0, 15, fill = mood.ink }:translate(x + look, 458)
      | circle { 5, -6, 5, fill = "#f1f0da" }:translate(x + look, 458)
  end
  return shown
end

local function arm(y)
  return gouache.taper(wash(300, 0, 360, 0, "#84918a", "#5a6a6b"), { 330, 280 }, { 318, y - 26 },
    44, 36)
    | form("#d9a883", "M-20 -20 H20 C26 0 18 30 12 32 C4 36 -8 36 -14 30 C-22 18 -26 0 -20 -20 "
    .. "Z"):translate(316, y)
end

return window.film { title = "Under the bed", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 2
  local pat = gouache.exposed(n, { 16, 352 }, { 1, 376 }, { 1, 366 }, { 1, 378 }, { 1, 366 }, { 1,
    378 },
    { 3, 352 })
  local happy = n >= 17 and n < 22
  local page = gouache.exposed(n, { 8, 0 }, { 1, 1 }, { 1, 2 }, { 14, 0 })
  local look = ({ -14, -10, -5, 0, 5, 10, 14, 14 })[n % 8 + 1]
  local laugh = (n == 12 or n == 14) and -5 or 0
  return { room, (body | tufts):translate(0, laugh), eyes(look, happy):translate(0, laugh),
    (line("M141 446 a35 35 0 1 0 70 0 a35 35 0 1 0 -70 0 M239 446 a35 35 0 1 0 70 0 "
      .. "a35 35 0 1 0 -70 0 M211 442 Q225 434 239 442", 5, "#a3761c") | form(mood.ink, "M212 "
      .. "482 Q225 474 238 482 L225 494 Z")
      | (laugh < 0 and form(mood.ink, "M196 502 Q225 512 254 502 Q244 526 225 526 "
      .. "Q206 526 196 502 Z")
        or line("M192 500 Q225 516 258 500", 5, mood.ink)) | form("#dfe6cf", "M238 504 L250 502 "
        .. "L246 516 Z"))
      :translate(0, laugh), bed, arm(pat), book,
    page > 0 and form("#f1f0da", page == 1 and "M228 540 L262 476 L300 470 L346 514 Z"
      or "M222 540 L180 470 L150 468 L104 514 Z") or union {}, paws }
end }
