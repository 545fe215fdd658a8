-- celspan sprites: the sheet and its atlas give back every frame of the film.
local json = require "celspan.json"
local movies = require "tests.support.movies"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it_reads = present.program "ffmpeg" and it or pending

--- A soft disc that goes to and fro; in the middle nothing is drawn.
local FILM = [[
local celspan = require "celspan"
local size = celspan.parameters { size = 64 }.size
return celspan.film { size = { size, 40 }, fps = 24, frames = 9, first = 8, frame = function(f)
  local x = 8 + 4 * math.min(f.index, 8 - f.index)
  local disc = celspan.circle { centre = { x, 20.3 }, radius = 6.4,
    texture = celspan.radial { centre = { x, 20 }, radius = 7, { 0, celspan.rgb("#f80", 1) },
      { 1, celspan.rgb("#24c", 0.2) } } }
  return celspan.rostrum { celspan.cel { f.index ~= 4 and disc or nil } }
end }
]]

describe("a sheet of sprites", function()
  local bench

  before_each(function()
    bench = workbench.new()
    bench:write("walk.lua", FILM)
  end)
  after_each(function() bench:remove() end)

  local function run(arguments, ...)
    local code, _, err = bench:celspan_inside(arguments, ...)
    assert.equal(0, code, err)
  end
  local function atlas(name) return assert(json.decode(bench:read(name))) end
  --- The pixels, of which clear ones have no colour.
  local function pixels(name)
    return (movies.pixels(bench, name, "rgba"):gsub("...(.)", { ["\0"] = "\0\0\0\0" }))
  end

  it_reads("gives back each frame, and has equal frames once", function()
    run "render walk.lua -o f/####.png --progress none"
    run "sprites walk.lua -o walk.tga --padding 3"
    local found = atlas "walk.json"
    assert.equal("walk.tga", found.meta.image)
    run "sprites walk.lua -o walk.png --padding 3"
    run "sprites walk.lua -o s/walk.png --padding 3 --workers 2"
    found = atlas "s/walk.json"
    assert.same({ "celspan", "walk.png", "RGBA8888", "1" },
      { found.meta.app, found.meta.image, found.meta.format, found.meta.scale })
    assert.is_true(bench:read "walk.png" == bench:read "s/walk.png")
    local width, height = found.meta.size.w, found.meta.size.h
    local sheet, places, milliseconds = pixels "walk.png", {}, 0
    assert.is_true(sheet == pixels "walk.tga")
    assert.equal(4 * width * height, #sheet)
    for number = 8, 16 do
      local one = found.frames[("walk.%04d.png"):format(number)]
      local at, from = one.frame, one.spriteSourceSize
      assert.same({ w = 64, h = 40 }, one.sourceSize)
      assert.same({ at.w, at.h, false, true }, { from.w, from.h, one.rotated, one.trimmed })
      assert.is_true(at.x >= 3 and at.y >= 3 and at.x + at.w + 3 <= width
        and at.y + at.h + 3 <= height)
      local rows, clear = {}, ("\0"):rep(64 * 4)
      for y = 0, 39 do
        local shift = (y - from.y + at.y) * width + at.x
        local inside = y >= from.y and y < from.y + from.h
        rows[y + 1] = not inside and clear or clear:sub(1, 4 * from.x)
          .. sheet:sub(4 * shift + 1, 4 * (shift + at.w))
          .. clear:sub(1, 4 * (64 - from.x - from.w))
      end
      assert.is_true(table.concat(rows) == pixels(("f/%04d.png"):format(number)), number)
      assert.equal(number == 12 and 1 or 14, at.h)
      assert.equal(number == 12 and 1 or 14, at.w) -- the least that holds the disc
      places[number] = at.x .. " " .. at.y
      milliseconds = milliseconds + one.duration
    end
    assert.equal(375, milliseconds)
    for number = 8, 15 do
      assert.equal(number ~= 12 and number ~= 11, places[number] == places[number + 1])
    end
  end)

  it("takes frames, sizes and tables", function()
    run "sprites walk.lua -o a.png --frames 9,12 --scale 2"
    local found = atlas "a.json"
    assert.same({ w = 128, h = 80 }, found.frames["a.0009.png"].sourceSize)
    assert.is_nil(found.frames["a.0010.png"])
    assert.equal("2", found.meta.scale)
    run "sprites walk.lua -o a.png --frames 9,12 --scale 0.5"
    assert.equal("0.5", atlas "a.json".meta.scale)
    run "sprites walk.lua -o a.png --frames 9,12 --size 128x80"
    assert.equal("1", atlas "a.json".meta.scale)
    bench:write("rows.csv", "size\n64\n32\n")
    run "sprites walk.lua -o 'b{size}.png' --table rows.csv"
    assert.equal(32, atlas "b32.json".frames["b32.0008.png"].sourceSize.w)
  end)

  it("is refused where it would be too large, or lose its alpha", function()
    local function refused(code, arguments, words, limit)
      local got, _, err = bench:inside(("%s'%s' sprites walk.lua %s%s"):format(limit or "",
        workbench.absolute, arguments, limit and limit ~= "" and ")" or ""))
      assert.equal(code, got, err)
      assert.truthy(err:find(words, 1, true), err)
      assert.is_nil(bench:read "out.png" or bench:read "out.json")
    end
    refused(2, "", "-o is missing: give -o sheet.png")
    refused(2, "-o out.jpg", "sprites need alpha without loss: give a name such as sheet.png")
    refused(2, "-o out.json", "sprites need alpha without loss")
    refused(2, "-o out.png --frames 1", "frame")
    bench:write("walk.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 20000, 2 }, frame = function()
  return celspan.rostrum { back = "#fff" } end }]])
    refused(6, "-o out.png", "out.png: the sheet would have 20004 x 6 pixels, and at most 16384")
    bench:write("walk.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 2048, 2048 }, frames = 17, frame = function(f)
  return celspan.rostrum { back = ("#0000%02x"):format(f.number) } end }]])
    local spare = present.sanitizer() and ""
      or "(ulimit -v 900000; MALLOC_ARENA_MAX=1 taskset -c 0 "
    refused(6, "-o out.png", "up to frame 17 the sprites have more than 67108864 pixels", spare)
  end)
end)
