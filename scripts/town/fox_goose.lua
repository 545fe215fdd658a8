-- A fox and a goose, each of whom can carry the other off on tiptoe. Both look to the right, with
-- their feet at y = 0.
local ink = require "town.silhouette"

local fox_goose = {}

--- How a foot moves under a body that walks: right of it and above the ground, for a share of two
--- steps of `long` each.
local function foot(share, long)
  share = share % 1
  if share < 0.5 then return long * (0.5 - 2 * share), 0 end
  local u = 2 * share - 1
  return long * (u * u * (3 - 2 * u) - 0.5), -math.sin(math.pi * u)
end

--- Two legs on tiptoe: hip, how far they have walked (in steps of two), widths at hip and ankle.
local function legs(hip, walked, long, lift, thick, thin)
  local parts = {}
  for i = 0, 1 do
    local x, up = foot(walked + 0.5 * i, long)
    local y = up * lift
    local heel = { x - 12 - 10 * up, y - 28 + 6 * up, thin }
    parts[#parts + 1] = ink.limb({ hip[1], hip[2], thick },
      { (hip[1] + x) / 2 + 30 - 56 * up, (hip[2] + y) / 2 - 4 + 16 * up, (thick + thin) / 2 }, heel)
    parts[#parts + 1] = ink.limb(heel, { x - 8, y - 8, thin }, { x + 16, y - 5, thin - 3 })
  end
  return union(parts)
end

local SIDE = path { d = "M-44 2 C-52 -34 -34 -58 -14 -62 L-8 -106 L22 -58 C40 -50 52 -38 62 -30 "
    .. "L122 -8 C126 2 116 8 106 8 L52 18 C20 32 -34 32 -44 2 Z" }
  | path { d = "M-40 -30 L-44 -92 L-4 -62 Z" }
local FRONT = path { d = "M0 46 L-18 24 C-42 16 -58 2 -66 -12 C-52 -20 -48 -30 -48 -42 L-54 -96 "
  .. "L-22 -64 C-10 -68 10 -68 22 -64 L54 -96 L48 -42 C48 -30 52 -20 66 -12 C58 2 42 16 18 24 Z" }
local function slit(x, y, lean)
  return path { d = "M-13 0 C-6 -11 6 -11 13 0 C6 7 -6 7 -13 0 Z" }:rotate(lean):translate(x, y)
end

--- A fox's head with its neck at (0, 0), and what is dark in it. `front`: it looks at us.
function fox_goose.fox_head(front, blink)
  local left, right = slit(-24, -22, 24), slit(24, -22, -24)
  if blink then left, right = left:scale(1, 0.25, "centre"), right:scale(1, 0.25, "centre") end
  if front then return FRONT, left | right | circle { 0, 38, 6 } end
  return SIDE, slit(30, -22, 16) | circle { 114, 2, 7 }
end

--- The fox, after a number of double steps. `front`: it looks at us; `hush`: its paw is at its
--- mouth. Returns its body and the arm that holds whom it carries.
function fox_goose.fox(walked, front, hush, sway)
  local bob = 7 * math.cos(4 * math.pi * walked)
  local hip = { -10, -150 + bob }
  local body = path { d = "M-40 -136 C-52 -190 -28 -250 8 -290 C22 -304 56 -296 58 -272 "
    .. "C62 -230 40 -160 14 -132 C-4 -118 -32 -118 -40 -136 Z" }:translate(0, bob)
  local tail = path { d = "M-26 -158 C-70 -134 -108 -132 -126 -158 C-146 -196 -166 -204 -196 -204 "
    .. "C-190 -150 -164 -98 -112 -96 C-70 -94 -40 -112 -18 -132 Z" }:rotate(sway, -26, -150)
  local paw = hush and { 66, -304, 14 } or { 150, -250, 14 }
  local free = ink.limb({ 40, -262 + bob, 26 }, { hush and 118 or 96, -216 + bob, 20 }, paw)
  local holds = ink.limb({ 26, -262 + bob, 34 }, { 18, -176 + bob, 32 }, { -46, -196 + bob, 22 })
  local head, dark = fox_goose.fox_head(front)
  return legs(hip, walked, 172, 74, 44, 16) | body | tail | free
    | (head - dark):translate(44, -318 + bob), holds
end

local GOOSE = path { d = "M84 -30 C66 8 6 40 -34 24 C-66 10 -66 -34 -36 -40 "
    .. "C6 -50 40 -20 84 -30 Z" } | ink.limb({ -40, -8, 40 }, { -108, -40, 24 }, { -84, -112, 22 })
  | circle { -84, -128, 26 }
local BEAKS = { path { d = "M-84 -130 L-73 -115 L-84 -104 L-95 -115 Z" },
  path { d = "M-104 -142 L-142 -120 L-100 -110 Z" } }

--- The goose that is carried, about the arm that holds it: its shape, and what is dark in it.
--- `front`: it looks at us, and not behind; `blink`: its eyes are shut.
function fox_goose.carried_goose(front, blink)
  local dark = front and BEAKS[1] or union {}
  for _, x in ipairs(front and { -96, -72 } or { -92 }) do
    dark = dark | (blink and rect { x - 6, -137, 12, 4 } or circle { x, -135, 5.5 })
  end
  return front and GOOSE or GOOSE | BEAKS[2], dark
end

--- The goose, as the fox above; what it holds is under its wing.
function fox_goose.goose(walked, front, hush)
  local bob = 8 * math.cos(4 * math.pi * walked)
  local body = path { d = "M-150 -214 C-110 -206 -92 -214 -70 -232 C-30 -262 30 -272 56 -240 "
    .. "C80 -206 58 -150 10 -134 C-50 -120 -104 -146 -150 -214 Z" }
  local head = circle { 70, -388, 38 }
  local dark = circle { 80, -396, 7 }
  if front then
    dark = circle { 54, -404, 7 } | circle { 86, -404, 7 }
      | path { d = "M70 -398 L90 -376 L70 -352 L50 -376 Z" }
  else
    head = head | path { d = "M92 -408 L156 -380 L92 -366 Z" }
  end
  local neck = ink.limb({ 34, -214, 60 }, { 106, -280, 40 }, { 68, -370, 32 })
  local tip = hush and { 124, -346, 18 } or { 146, -264, 18 }
  local free = ink.limb({ 44, -214, 40 }, { hush and 146 or 104, -216, 40 }, tip)
  local holds = ink.limb({ 24, -222, 44 }, { 6, -150, 40 }, { -64, -176, 24 })
  return legs({ -6, -136 + bob }, walked, 172, 74, 30, 13)
    | ((body | head | neck | free) - dark):translate(0, bob), holds:translate(0, bob)
end

--- The fox that is carried: its shape, and what is dark in it.
function fox_goose.carried_fox(blink)
  local head, dark = fox_goose.fox_head(true, blink)
  local function place(object) return object:scale(0.86):translate(-96, -92) end
  local tail = path { d = "M62 4 C96 20 84 70 96 96 C100 124 124 132 128 140 "
    .. "C144 120 150 80 134 40 C124 10 96 -20 66 -24 Z" }
  return ink.limb({ 64, -6, 50 }, { 10, -26, 66 }, { -70, -20, 54 }) | tail | place(head)
    | ink.limb({ -64, -10, 24 }, { -70, 30, 18 }, { -86, 56, 14 })
    | ink.limb({ -84, -16, 24 }, { -104, 20, 18 }, { -114, 46, 14 })
    | ink.limb({ 50, 0, 30 }, { 50, 40, 22 }, { 34, 72, 15 }), place(dark)
end

--- The light of a cellar's grating, and a shelf.
function fox_goose.cellar()
  local shelf = path { d = "M30 126 H178 V134 H30 Z M44 126 V82 C44 70 52 72 52 44 H64 "
    .. "C64 72 72 70 72 82 V126 Z M92 126 V90 H88 V80 H130 V90 H126 V126 Z M142 126 V94 "
    .. "C142 78 150 82 150 58 H160 C160 82 168 78 168 94 V126 Z" }
  return path { d = "M258 110 H364 L424 600 H34 Z" } | rect { 258, 44, 30, 50 }
    | rect { 296, 44, 30, 50 } | rect { 334, 44, 30, 50 } | shelf
end

return fox_goose
