-- Makes fox.ora, the painted puppet of scripts/fox.lua:
--
--   LUA_CPATH=build/?.so lua5.4 scripts/paintings/fox.lua      from the root of the tree
--
-- Each layer is a part that a bone moves. Neighbours overlap at their joints with round ends. The
-- middle of a layer "joint NAME", a dot, is a joint.
package.path = "./?.lua;" .. package.path
local draw = require "scripts.paintings.draw"
local paintings = require "tests.support.paintings"

local W, H = 720, 440

--- Brush strokes of fur in a shape, which lean in the direction { x, y }, and stay inside of it.
local function fur(shape, seed, direction, light, dark)
  local x, y, w, h = shape:bounds()
  local random, strokes = celspan.random(seed), {}
  for i = 1, w * h // 40 do
    local px, py = x + w * random("x" .. i), y + h * random("y" .. i)
    local length, bend = 0.6 + 0.8 * random("length" .. i), 6 * (random("bend" .. i) - 0.5)
    local dx, dy = direction[1] * length, direction[2] * length
    strokes[i] = stroke { taper = { 1, 6 }, width = 1.2 + 2.2 * random("width" .. i),
      d = ("M%.2f %.2f q%.2f %.2f %.2f %.2f"):format(px, py, dx / 2 + bend, dy / 2 - bend, dx, dy),
      fill = random("shade" .. i) < 0.5 and light or dark }
      :fade(0.2 + 0.5 * random("alpha" .. i))
  end
  return clip(union(strokes), shape)
end

--- A painted part: a shape from one colour above to another below, with fur.
local function part(d, above, below, direction, seed)
  local plain = path { d = d }
  local _, y, _, h = plain:bounds()
  local paint = linear { from = { 0, y }, to = { 0, y + h }, { 0, above }, { 1, below } }
  return union { plain:paint(paint), fur(plain, seed, direction,
    colour.lighten(above, 0.13), colour.lighten(below, -0.09)) }
end

local RED, RUST, SOCK, CREAM = "#e8833a", "#b4501f", "#3a221c", "#fbeedd"
local BACK = { -13, 4 } -- how the fur lies
local DOWN = { -4, 14 }

local layers = {}
local function add(name, ...) layers[#layers + 1] = { name = name, ... } end

--- Legs: the far ones are the same, in shade, a little further to the right and up.
local function legs(side, x, y, shade)
  local function limb(name, d, above, below)
    local art = part(d, colour.lighten(above, -shade), colour.lighten(below, -shade / 2), DOWN,
      name .. side)
    add(name .. " " .. side, art:translate(x, y))
  end
  limb("foot", "M248 340C254 334 264 338 266 346C266 364 268 380 274 388C290 388 297 394 294 402"
    .. "H252C248 390 244 360 248 340Z", SOCK, SOCK)
  limb("shank", "M280 284C296 282 306 294 301 307C288 327 272 341 266 352C258 358 245 351 248 339"
    .. "C256 318 264 296 280 284Z", RUST, SOCK)
  limb("thigh", "M232 226C256 200 298 214 304 250C312 280 312 302 296 310C278 308 260 296 248 276"
    .. "C234 262 226 244 232 226Z", RED, RUST)
  limb("paw", "M452 346C460 338 472 344 473 352C475 368 478 380 484 388C498 390 502 396 500 402"
    .. "H460C456 386 450 364 452 346Z", SOCK, SOCK)
  limb("fore", "M435 291C443 283 459 285 463 296C465 318 471 336 474 352C472 361 457 363 453 354"
    .. "C447 334 439 314 435 291Z", RUST, SOCK)
  limb("upper", "M438 222C456 202 488 212 490 240C488 268 474 294 460 308C446 311 434 301 436 288"
    .. "C437 266 430 244 438 222Z", RED, RUST)
end

legs("far", 18, -5, 0.2)
add("brush", part("M160 234C120 226 92 250 46 232C36 262 60 304 112 302C134 300 152 290 164 274Z",
  RED, RUST, { -15, 3 }, "brush"), part("M92 243C78 246 62 240 46 232C36 262 60 304 112 302"
    .. "C92 288 84 264 92 243Z", CREAM, "#e6cdb0", { -14, 4 }, "tip"))
add("tail", part("M246 212C204 196 162 208 134 228C122 244 126 272 146 282C184 282 210 262 250 "
  .. "248Z", RED, RUST, { -15, 3 }, "tail"))
add("body", part("M232 214C250 176 330 176 390 184C440 170 492 172 508 212C516 252 490 292 446 294"
  .. "C410 288 360 264 318 270C288 290 250 294 232 270C218 252 220 232 232 214Z", RED, "#c9652b",
  BACK, "body"), part("M470 226C506 228 512 262 484 288C462 298 440 292 444 280C448 258 456 236 470"
    .. " 226Z", CREAM, "#ecd5b8", { -5, 11 }, "chest"))
add("ear far", part("M548 122C548 92 556 72 569 58C580 80 584 108 576 130Z", "#8a3d18", RUST, DOWN,
  "far"))
add("head", part("M464 222C456 180 476 134 520 116C554 104 582 120 592 142C606 150 626 158 637 167"
  .. "C641 176 632 185 619 185C598 194 580 202 560 206C536 226 494 250 464 222Z", RED, "#d8702c",
  BACK, "head"), part("M508 226C530 196 566 182 602 178C618 179 628 182 619 185C598 194 580 202 560"
    .. " 206C544 220 526 228 508 226Z", CREAM, "#f3dfc6", BACK, "cheek"),
  path { d = "M566 156Q576 142 588 154Q576 160 566 156Z", fill = "#241512" },
  circle { 579, 151, 1.6, fill = "#fff" },
  ellipse { 634, 169, 8, 7, fill = "#1d1413" },
  stroke { d = "M622 182Q606 186 592 186", width = 2, cap = "round", fill = "#5b2c1a" })
add("ear near", part("M510 130C502 92 505 68 514 50C534 68 552 96 554 124Z", RED, RUST, DOWN,
  "ear"),
  path { d = "M522 122C516 98 516 82 519 70C532 84 540 102 541 120Z", fill = "#5b2a1a" })
legs("near", 0, 0, 0)

local points = { rump = { 238, 230 }, withers = { 470, 206 }, nose = { 634, 169 },
                 bend = { 146, 254 }, tip = { 52, 262 }, ["ear root near"] = { 532, 126 },
                 ["ear tip near"] = { 516, 56 }, ["ear root far"] = { 560, 126 },
                 ["ear tip far"] = { 569, 60 } }
for name, point in pairs { hip = { 264, 240 }, knee = { 290, 296 }, hock = { 257, 346 },
                           toe = { 284, 398 }, shoulder = { 464, 236 }, elbow = { 449, 297 },
                           wrist = { 463, 352 }, nail = { 490, 398 } } do
  points[name .. " near"], points[name .. " far"] = point, { point[1] + 18, point[2] - 5 }
end
local names = {}
for name in pairs(points) do names[#names + 1] = name end
table.sort(names)
for _, name in ipairs(names) do
  add("joint " .. name, circle { centre = points[name], radius = 3, fill = "#0a0" })
end

for _, layer in ipairs(layers) do
  local picture = draw(union { table.unpack(layer) }, W, H, 1)
  layer.x, layer.y, layer.png = picture.x, picture.y, picture.png
end
local file = assert(io.open(arg[1] or "scripts/paintings/fox.ora", "wb"))
assert(file:write(paintings.openraster { w = W, h = H, layers = layers }))
file:close()
