--- celspan describe, and what celspan check warns of: what is seen of a film.
local json = require "celspan.json"
local flashes = require "tests.support.flashes"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local it_sets_type = present.type() and it or pending

local HEAD = [[
local celspan = require "celspan"
local function text(words, x, y, colour, size)
  return celspan.text { words, font = "block.ttf", size = size or 24, at = { x, y },
    texture = colour }
end
local function cel(...) return celspan.cel { ... } end
return celspan.film { size = { 320, 180 }, fps = 24, frames = %d, frame = function(f)
  local ball = celspan.circle { centre = { 20 + 5 * f.index, 90 }, radius = 10, texture = "#f80" }
  return celspan.rostrum { back = "#202040", cel(ball:named "ball"):named "actors", %s }
end }
]]

local bench

local function film(frames, cels)
  bench:write("film.lua", HEAD:format(frames, cels))
end

--- What check warns of, with where each was made.
local function warnings(options)
  local code, out, err = bench:celspan_inside("check film.lua --json %s", options or "")
  assert.are.equal(0, code, err)
  return assert(json.decode(out))
end

--- The one warning, which contains this.
local function warns(text, options)
  local list = warnings(options)
  assert.are.equal(1, #list, text)
  assert.truthy(list[1].message:find(text, 1, true), list[1].message)
  assert.are.equal("warning", list[1].level)
  return list[1]
end

describe("what is seen of a film", function()
  before_each(function()
    bench = workbench.new()
    bench:write("block.ttf", assert(io.open "scripts/type/block.ttf"):read "a")
  end)
  after_each(function() bench:remove() end)

  it_sets_type("is reported by check where text cannot be read", function()
    film(48, 'cel(text("Read me", 20, 40, "#fff"))')
    assert.same({}, warnings())
    film(48, 'cel(text("Dim", 20, 40, "#303050"))')
    local dim = warns 'the text "Dim" (film.lua:3) has a contrast of 1.2 to its background'
    assert.same({ 1, "1-48", "film.lua", 3 }, { dim.frame, dim.frames, dim.file, dim.line })
    film(48, 'cel(text("Out", 290, 40, "#fff"))')
    warns "lies outside of the frame in all of its frames, at the right side"
    film(48, 'cel(text("Tiny", 20, 40, "#fff", 2.4))')
    warns "has letters of 2.4 units, less than 1/72 of the frame's height"
    film(48, 'cel(text("Grows", 20, 40, "#fff", 2 + f.index / 40))')
    assert.same({}, warnings())
    film(48, 'cel(text("Hid", 20, 40, "#fff")), cel(celspan.rect { 10, 10, 150, 40 })')
    warns "is covered by nearer cels in all of its frames, 100 % of it at least"
  end)

  it_sets_type("is measured for fifty texts of a frame, however many it has", function()
    film(2, '(function() local all = {} for i = 1, 300 do all[i] = text("Dim " .. i, '
      .. '5 + i // 18 * 18, 5 + i % 18 * 10, "#303050", 8) end '
      .. 'return cel(table.unpack(all)) end)()')
    local dim = 0
    for _, one in ipairs(warnings()) do
      if one.message:find("has a contrast of", 1, true) then dim = dim + 1 end
    end
    assert.is_true(dim > 0 and dim <= 50, dim)
  end)

  it_sets_type("is reported by check where one text lies over another", function()
    film(48, 'cel(text("Read me", 20, 40, "#fff")), cel(text("Another", 24, 44, "#f80"))')
    local one = warns 'the text "Read me" (film.lua:3) has the text "Another" over it'
    assert.are.equal("1-48", one.frames)
    film(48, 'cel(text("Read me", 20, 40, "#fff")), cel(text("Another", 24, 74, "#f80"))')
    assert.same({}, warnings())
    -- one is a copy, or passes by, or follows in a dissolve, or is a decoration
    film(48, 'cel(text("Read me", 22, 42, "#000")), cel(text("Read me", 20, 40, "#fff"))')
    assert.same({}, warnings())
    film(48, 'cel(text("Read me", 100, 40, "#fff")), '
      .. 'cel(text("Another", 280 - 14 * f.index, 40, "#f80"))')
    assert.same({}, warnings())
    film(48, 'cel(text("Read me", 20, 40, "#fff"):fade(1 - f.index / 47)), '
      .. 'cel(text("Another", 20, 40, "#f80"):fade(f.index / 47))')
    assert.same({}, warnings())
    film(48, 'cel(text("Big", 20, 120, "#88f", 100)), cel(text("Another", 24, 104, "#fff"))')
    assert.same({}, warnings())
  end)

  it_sets_type("is right about a text that appears, passes by or is uncovered", function()
    film(48, 'cel(text("Slowly", 20, 40, "#fff"):fade(math.min(1, f.index / 20)))')
    assert.same({}, warnings())
    film(60, 'cel(text("A line that passes", 320 - 12 * f.index, 40, "#fff"))')
    assert.same({}, warnings())
    film(48, 'cel(text("Hid", 20, 40, "#fff")), '
      .. 'f.index ~= 30 and cel(celspan.rect { 10, 10, 150, 40, texture = "#888" }) or nil')
    assert.same({}, warnings())
  end)

  it_sets_type("looks at the letters of a text with effects, not at the effects", function()
    for _, effect in ipairs { 'glow { radius = 30, colour = "#222" }',
      'shadow { offset = { -30, 4 }, blur = 5 }', 'outline { width = 20, texture = "#f00" }',
      'outline { width = 3, texture = "#000" }:shadow { offset = { -9, 0 } }:fade(0.9)' } do
      film(48, 'cel(text("Lit", 4, 40, "#fff"):' .. effect .. ')')
      assert.same({}, warnings(), effect)
      local _, out = bench:celspan_inside "describe film.lua --frames 1-2"
      assert.are.equal(1, select(2, out:gsub("\ntext ", "")), out)
    end
    film(48, 'cel(text("Dim", 20, 40, "#303050"):shadow { offset = { 2, 2 } })')
    warns "has a contrast of"
    film(48, 'cel(text("Soft", 130, 120, "#888"):blur(20))')
    warns "has a contrast of"
  end)

  it_sets_type("includes how long a text needs", function()
    film(48, 'f.index < 24 and cel(text("Two words", 20, 40, "#fff")) or nil')
    assert.same({}, warnings())
    film(48, 'f.index < 23 and cel(text("Two words", 20, 40, "#fff")) or nil')
    assert.are.equal("1-23", warns("is shown for 0.9583 s; its 2 words need 1 s").frames)
    film(48, 'f.index < 24 and cel(text("Two · words –", 20, 40, "#fff")) or nil')
    assert.same({}, warnings())
    -- the frames around it were not looked at
    assert.same({}, warnings "--frames 1-10")
    film(48, 'cel(text(tostring(f.number * 100), 20, 40, "#fff"))')
    assert.same({}, warnings())
    film(48, 'cel(text(("It is typed"):sub(1, f.number), 20, 40, "#fff"))')
    assert.same({}, warnings())
    film(48, 'f.index < 6 and cel(celspan.letters({ "So brief", font = "block.ttf", size = 24, '
      .. 'at = { 20, 40 }, texture = "#fff" })) or nil')
    warns 'the text "So brief"'
  end)

  local STILL = [[
local celspan = require "celspan"
local sheet = require "celspan.sheet"
local held = sheet.new { layers = { "body" }, drawings = { body = { [1] = "1", [40] = "2" } },
  fps = 24, frames = 60 }
return celspan.film { size = { 16, 9 }, fps = 24, frames = 60, frame = function(f)
  local n = %s
  return celspan.rostrum { back = "#fff", celspan.cel { celspan.rect { n, 1, %s, 4 } } }
end }]]

  it("includes what stands still, or is empty", function()
    bench:write("film.lua", STILL:format("f.index // 24", "4"))
    local list = warnings()
    assert.are.equal(2, #list)
    assert.are.equal("25-48", list[2].frames)
    assert.truthy(list[2].message:find("nothing changes for 1 s", 1, true), list[2].message)
    bench:write("film.lua", STILL:format("f.index // 23", "4"))
    assert.same({}, warnings())
    bench:write("film.lua", STILL:format("tonumber(held:at('body', f.number))", "4"))
    assert.same({}, warnings())
    bench:write("film.lua", STILL:format("f.index / 5", "f.index < 24 and 0 or 4"))
    assert.are.equal("1-24", warns("nothing but one colour is seen for 1 s").frames)
  end)

  local TITLE = [[
local celspan = require "celspan"
return celspan.film { size = { 320, 180 }, fps = 24, frames = %d, frame = function()
  return celspan.rostrum { celspan.cel { celspan.text { "Two words", font = "block.ttf", size = 24,
    at = { 20, 40 }, texture = "#fff" } } }
end }]]

  it_sets_type("includes a title that is shown 3 s longer than it takes to be read", function()
    bench:write("film.lua", TITLE:format(96))
    assert.same({}, warnings())
    bench:write("film.lua", TITLE:format(97))
    warns "nothing changes for 4.042 s"
  end)

  it_sets_type("is described as text and as JSON", function()
    film(48, 'f.index < 24 and cel(text("Good day", 20, 40, "#fff")):named "title" or nil')
    local code, out, err = bench:celspan_inside "describe film.lua"
    assert.are.equal(0, code, err)
    assert.are.equal([[
size 320x180
fps 24
frames 1-48
seconds 2
sound no
shot 1-48 0-2 s
cel 1-48 0-2 s share 0.00694 moving name actors (film.lua:6)
object 1-48 0-2 s share 0.00694 moving name ball (film.lua:8)
]], (out:gsub("cel 1%-24.*", "")))
    assert.truthy(out:find("\ncel 1%-24 0%-1 s share [%d.]+ still name title %(film.lua:%d+%)\n"),
      out)
    assert.truthy(out:find("\ntext 1%-24 0%-1 s pixels 24 contrast 15.6 covered 0 share [%d.]+ "
      .. "still words Good day %(film.lua:3%)\n"), out)
    local _, text = bench:celspan_inside "describe film.lua --json --frames 1-12"
    local facts = assert(json.decode(text))
    assert.same({ { 320, 180 }, 48, 1, "Good day", 12 }, { facts.size, facts.last, #facts.shots,
      facts.texts[1].words, facts.texts[1].last })
    assert.same({ {}, {}, {}, {} }, { facts.empty, facts.frozen, facts.flashes, facts.marks })
  end)

  it("has shots between cuts, and none in a flash", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 16, 9 }, fps = 24, frames = 48, frame = function(f)
  local light = f.number == 40 and 1 or f.index < 20 and 0.1 or 0.6
  return celspan.rostrum { back = { light, light, light, 1 },
    celspan.cel { celspan.rect { f.index / 8, 1, 4, 4 } } }
end }]])
    local _, out = bench:celspan_inside "describe film.lua"
    assert.truthy(out:find("\nshot 1-20 0-0.8333 s\nshot 21-48 0.8333-2 s\ncel", 1, true), out)
  end)

  it("does not see frames whose pictures cannot be read, nor holds them", function()
    bench:write("film.lua", [[
local celspan = require "celspan"
return celspan.film { size = { 16, 9 }, fps = 24, frames = 48, frame = function()
  return celspan.rostrum { celspan.cel { celspan.image { file = "none.png", w = 3, h = 3 } } }
end }]])
    local _, text = bench:celspan_inside "describe film.lua --json"
    local facts = assert(json.decode(text))
    assert.same({ { { first = 1, last = 48, from = 0, to = 2 } }, {} },
      { facts.unseen, facts.frozen })
  end)

  it("lists cels by the names that they have", function()
    film(12, 'cel(celspan.rect { 0, 0, 9, 9 }):named "left/cel 2"')
    local _, out = bench:celspan_inside "describe film.lua"
    assert.truthy(out:find("name left/cel 2 (film.lua:6)", 1, true), out)
  end)

  it("refuses what it cannot describe", function()
    assert.are.equal(4, (bench:celspan_inside "describe none.lua"))
    bench:write("film.lua", "return 3")
    assert.are.equal(3, (bench:celspan_inside "describe film.lua"))
    bench:write("film.lua", STILL:format("f.index == 9 and nil or 1", "4"))
    assert.are.equal(0, (bench:celspan_inside "describe film.lua --frames 1-9"))
    assert.are.equal(2, (bench:celspan_inside "describe film.lua --frames 61"))
    bench:write("film.lua", (STILL:format("f.index == 9 and {} or 1", "4")))
    local code, _, err = bench:celspan_inside "describe film.lua"
    assert.are.equal(3, code)
    assert.truthy(err:find("frame 10", 1, true), err)
  end)
end)

-- ---------------------------------------------------------------- flashes

describe("flashes by WCAG 2.3.1", function()
  it("are found on one side of each limit and not on the other", function()
    bench = workbench.new()
    bench:write("film.lua", flashes.FILM)
    local wrong = {}
    for _, one in ipairs(flashes.MADE) do
      local given = table.concat(one, " ", 1, 7)
      local code, out, err = bench:celspan_inside("check film.lua --json --frames 1-100 -- %s",
        given)
      assert.are.equal(0, code, err)
      if (out:find("three flashes", 1, true) ~= nil) ~= one[8] then wrong[#wrong + 1] = given end
    end
    bench:remove()
    assert.same({}, wrong)
  end)
end)
