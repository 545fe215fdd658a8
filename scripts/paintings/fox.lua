-- Makes fox.ora, the painted puppet of scripts/fox.lua:
--
--   LUA_CPATH=build/?.so lua5.4 scripts/paintings/fox.lua      from the root of the tree
--
-- Each layer is a part that a bone moves. Neighbours overlap at their joints with round ends. The
-- middle of a layer "joint NAME", a dot, is a joint.
package.path = "./?.lua;" .. package.path
setmetatable(_G, { __index = require("celspan").names {} })
local draw = require "scripts.paintings.draw"
local paintings = require "tests.support.paintings"

local W, H = 720, 450

--- Brush strokes of fur in a shape, which lean in the direction { x, y }, and stay inside of it.
local function fur(shape, seed, direction, light, dark)
  local x, y, w, h = shape:bounds()
  local random, strokes = celspan.random(seed), {}
  for i = 1, w * h // 40 do
    local px, py = x + w * random("x" .. i), y + h * random("y" .. i)
    local length, bend = 0.6 + 0.8 * random("length" .. i), 6 * (random("bend" .. i) - 0.5)
    local dx, dy = direction[1] * length, direction[2] * length
    strokes[i] = stroke { taper = { 1, 6 }, width = 1 + 1.8 * random("width" .. i),
      d = ("M%.2f %.2f q%.2f %.2f %.2f %.2f"):format(px, py, dx / 2 + bend, dy / 2 - bend, dx, dy),
      fill = random("shade" .. i) < 0.5 and light or dark }
      :fade(0.2 + 0.4 * random("alpha" .. i))
  end
  return clip(union(strokes), shape)
end

--- A painted part: a shape from one colour above to another below, with fur.
local function part(d, above, below, direction, seed)
  local plain = path { d = d }
  local _, y, _, h = plain:bounds()
  local paint = linear { from = { 0, y }, to = { 0, y + h }, { 0, above }, { 1, below } }
  return union { plain:paint(paint), fur(plain, seed, direction,
    colour.lighten(above, 0.07), colour.lighten(below, -0.08)) }
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
  limb("foot", "M248 358C254 351 264 356 266 365C265 387 268 406 273 416C290 416 299 424 296 433"
    .. "H254C247 418 243 384 248 358Z", SOCK, SOCK)
  limb("shank", "M279 294C294 290 305 302 300 316C288 340 274 358 266 373C258 381 245 372 248 358"
    .. "C256 334 264 308 279 294Z", RUST, SOCK)
  limb("thigh", "M226 232C242 200 296 206 310 248C314 276 310 308 298 321C282 320 268 310 256 290"
    .. "C240 270 220 254 226 232Z", RED, RUST)
  limb("paw", "M454 367C461 358 472 364 473 373C474 393 477 407 483 417C499 418 505 426 502 433"
    .. "H462C456 415 451 389 454 367Z", SOCK, SOCK)
  limb("fore", "M438 300C446 291 460 294 463 306C466 334 471 354 474 372C472 383 458 386 454 376"
    .. "C448 352 442 328 438 300Z", RUST, SOCK)
  limb("upper", "M440 224C456 200 490 208 494 240C492 272 476 304 462 319C448 322 437 312 438 298"
    .. "C438 270 432 246 440 224Z", RED, RUST)
end

legs("far", 20, -6, 0.2)
add("brush", part("M192 246C152 234 112 262 64 240C42 230 26 214 16 194C0 246 40 332 120 336"
  .. "C162 336 192 318 206 292Z", RED, RUST, { -15, 0 }, "brush"), part("M74 245L63 256L74 267"
    .. "L62 278L78 287L74 301L92 307L94 331C36 318 2 250 16 194C26 214 44 236 74 245Z", CREAM,
    "#e6cdb0", { -13, -3 }, "tip"))
add("tail", part("M258 202C228 198 198 218 174 244C160 268 168 302 192 306C222 294 246 268 260 "
  .. "242Z", RED, RUST, { -12, 9 }, "tail"))
add("body", part("M228 222C236 190 270 168 318 164C362 160 396 172 428 180C462 164 496 178 508 212"
  .. "C518 252 494 300 450 304C412 300 372 262 326 258C298 262 270 290 244 272C226 258 222 240 228 "
  .. "222Z", RED, "#bf5f28", BACK, "body"), part("M476 206C512 214 516 262 484 296L474 288L466 304"
    .. "L456 292L444 300C446 272 456 232 476 206Z", CREAM, "#ecd5b8", { -5, 11 }, "chest"))
add("ear far", part("M556 136C552 104 560 84 578 64C592 88 598 116 590 142Z", "#8a3d18", SOCK,
  DOWN, "far"))
add("head", part("M450 226C452 194 474 164 504 146C528 126 566 122 588 140C602 152 612 162 626 168"
  .. "C642 174 656 180 661 187C663 196 654 201 640 202C622 206 606 212 592 218L588 230L574 228L568 "
  .. "242L552 240C534 262 498 278 468 262C454 252 449 240 450 226Z", RED, "#d8702c", BACK, "head"),
  part("M655 191C659 198 652 201 640 202C622 206 606 212 592 218L588 230L574 228L568 242L552 240"
    .. "C540 256 520 266 500 268C504 246 520 226 544 216C572 206 594 194 618 188C632 185 646 185 "
    .. "655 191Z", CREAM, "#f3dfc6", BACK, "cheek"),
  path { d = "M582 170C586 160 598 158 608 170C600 176 590 176 582 170Z", fill = "#241512" },
  circle { 598, 166, 2, fill = "#fff" },
  ellipse { 655, 188, 9, 7, fill = "#1d1413" },
  stroke { d = "M644 202Q628 206 612 203", width = 2.4, cap = "round", fill = "#5b2c1a" })
add("ear near", part("M508 150C496 106 500 76 512 54C538 74 560 106 564 140Z", RED, RUST, DOWN,
  "ear"), path { d = "M502 88C503 74 507 64 512 54C522 62 532 72 540 84C526 78 514 80 502 88Z",
    fill = SOCK },
  path { d = "M524 140C514 112 512 96 516 82C534 98 546 118 550 138Z", fill = "#5b2a1a" })
legs("near", 0, 0, 0)

local points = { rump = { 240, 228 }, withers = { 466, 214 }, nose = { 652, 188 },
                 bend = { 180, 273 }, tip = { 26, 216 }, ["ear root near"] = { 536, 144 },
                 ["ear tip near"] = { 514, 60 }, ["ear root far"] = { 572, 140 },
                 ["ear tip far"] = { 578, 68 } }
for name, point in pairs { hip = { 264, 240 }, knee = { 289, 306 }, hock = { 257, 366 },
                           toe = { 286, 429 }, shoulder = { 466, 236 }, elbow = { 451, 308 },
                           wrist = { 464, 372 }, nail = { 492, 429 } } do
  points[name .. " near"], points[name .. " far"] = point, { point[1] + 20, point[2] - 6 }
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
