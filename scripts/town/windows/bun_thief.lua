-- The baker counts his buns; a hand from below takes one, and another one, and he counts again.
local baker = require "town.baker"
local gouache = require "town.gouache"
local window = require "town.window"
local wash, form, line = gouache.wash, gouache.form, gouache.line

local room = union {
  gouache.wall(420, 260, 480, "#ffd890", "#e08f3e", "#9a4e22", "#5a2a15"),
  form("#7a3a1a", "M0 186 H130 V200 H0 Z"), baker.loaf:scale(0.8):translate(72, 168),
}
local counter = union {
  form(wash(0, 0, 450, 0, "#8d4a26", "#d98f4a"), "M0 414 H450 V440 H0 Z"),
  form(wash(0, 0, 450, 0, "#4d2413", "#7a3a1a"), "M0 440 H450 V600 H0 Z"),
  form("#8d4a26", "M20 468 H210 V540 H20 Z M240 468 H430 V540 H240 Z"),
}
local thief = line("M0 0 V270", 34, "#1f6f78") | line("M-16 40 H16", 8, "#f3dcaa")
  | form("#ffcf9c", "M-22 10 C-30 -14 -22 -30 -12 -26 C-8 -38 6 -38 8 -28 C18 -34 26 -20 24 -6 "
  .. "C24 8 16 16 0 18 C-10 18 -18 16 -22 10 Z")

local function bun(i)
  return baker.loaf:scale(0.72):translate(-18 + 81 * i, 398)
end

--- How high the thief's hand is, and which bun it goes for.
local hands = { { 4, gouache.track({ 6, 640 }, { 8, 440 }, { 9, 392 }, { 10, 440 }, { 12, 640 }),
  9 },
  { 2, gouache.track({ 13, 640 }, { 14, 440 }, { 15, 392 }, { 16, 460 }, { 17, 640 }), 15 } }

return window.film { title = "The buns", by = "ga", seconds = 4, drawing = function(_, number)
  local n = number // 2
  local away = gouache.track({ 19, 0 }, { 20, 170 }, { 21, 170 }, { 22, 0 }):at(n)
  local counted = gouache.exposed(n, { 1, 1 }, { 1, 2 }, { 1, 3 }, { 1, 4 }, { 1, 5 }, { 5, nil },
    { 1, 1 },
    { 1, 2 }, { 1, 3 }, { 11, nil })
  local stage = counted and "count" or gouache.exposed(n, { 10, "proud" }, { 7, "think" },
    { 3, "shock" }, { 4, "proud" })
  local right = counted and { 81 * counted - 10, 360 } or stage == "think" and { 300, 196 }
    or { 316, 386 + away }
  local shown = { room, baker.draw { x = 225, y = 274 + away, left = { 140, 386 + away },
    right = right,
    face = ({ count = { -16 + 7 * (counted or 0), 10 }, proud = { 2, -12 }, think = { -8, -12 },
      shock = { 0, 12 } })[stage], eyes = stage == "proud" and "happy" or "open",
    brow = ({ count = 2, proud = 6, think = 0, shock = 12 })[stage],
    mouth = stage == "shock" and "M-5 44 Q0 38 5 44 Q0 52 -5 44" }, baker.hand(225, { 140,
      386 + away }) }
  for i = 1, 5 do
    if n >= 21 or (i ~= 4 or n < 9) and (i ~= 2 or n < 15) then shown[#shown + 1] = bun(i) end
  end
  shown[#shown + 1] = counter
  for _, hand in ipairs(hands) do
    local y = hand[2]:at(n)
    local x = -18 + 81 * hand[1]
    if y < 640 then
      shown[#shown + 1] = thief:translate(x, y)
      shown[#shown + 1] = n >= hand[3] and baker.loaf:scale(0.72):translate(x, y - 16) or union {}
    end
  end
  shown[#shown + 1] = away < 40 and baker.hand(225, right) or union {}
  return shown
end }
