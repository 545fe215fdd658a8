-- Charts: where their marks are, and that no label covers another.
local celspan = require "celspan"
local chart = require "celspan.chart"
local own = require "tests.support.own"
local labels, ticks = own "celspan.labels", own "celspan.ticks"
local present = require "tests.support.present"
local prng = require "tests.support.prng"
local raised = require "tests.support.raised"

local FONT = "/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf" -- has a minus sign, and "%"
local with_art = present.type() and io.open(FONT) and it or pending

--- A chart in 100 x 100 units without axes.
local function plain(kind, data, changes)
  local given = { kind = kind, data = data, box = { 0, 0, 100, 100 }, axes = false }
  for name, value in pairs(changes or {}) do given[name] = value end
  return chart(given)
end

--- Whether points { x, y } are inside of an object, as a list.
local function inside(object, points)
  local list = {}
  for i, point in ipairs(points) do list[i] = object:contains(point[1], point[2]) end
  return list
end

describe("ticks", function()
  it("are few round numbers that cover the range", function()
    local random = prng.new(1)
    for _ = 1, 3000 do
      local low = random:between(-1, 1) * 10 ^ random:whole(-6, 11)
      local high = low + random:between(0, 1) * 10 ^ random:whole(-9, 11)
      local most, is_whole = random:whole(3, 9), random:once(3)
      local list, decimals, first, last = ticks.between(low, high, most, is_whole)
      local step = list[2] - list[1]
      local digit = step / 10 ^ math.floor(math.log(1.01 * step, 10))
      assert.is_true(#list <= most and first <= low and last >= high, low .. " " .. high)
      assert.is_true(math.min(math.abs(digit - 1), math.abs(digit - 2), math.abs(digit - 5)) < 1e-2)
      assert.is_true(not is_whole or decimals == 0)
    end
    assert.same({ 0, 0.1, 0.2, 0.3 }, (ticks.between(0, 0.3, 5)))
    assert.same({ 2000, 2005, 2010 }, (ticks.between(1998, 2011, 4, true, true)))
    assert.same({ 7, 7.5, 8 }, (ticks.between(7, 7, 3)))
  end)
end)

describe("labels", function()
  it("that are moved apart are as near to their places as can be", function()
    local random = prng.new(2)
    for _ = 1, 400 do
      local wanted, count = {}, random:whole(1, 6)
      for i = 1, count do wanted[i] = random:between(0, 60) end
      table.sort(wanted)
      local places = labels.spread(wanted, 8, 4, 60)
      local function cost(list)
        local sum = 0
        for i, at in ipairs(list) do
          if at < 4 - 1e-9 or at > 60 + 1e-9 then return math.huge end
          if i > 1 and at - list[i - 1] < 8 - 1e-9 then return math.huge end
          sum = sum + (at - wanted[i]) ^ 2
        end
        return sum
      end
      local least = cost(places)
      assert.is_true(least < math.huge)
      for _ = 1, 60 do
        local other = table.move(places, 1, count, 1, {})
        for i = random:whole(1, count), count do other[i] = other[i] + random:between(-0.4, 0.4) end
        assert.is_true(cost(other) >= least - 1e-6)
      end
    end
    assert.is_nil(labels.spread({ 1, 2, 3 }, 8, 0, 15))
  end)
end)

describe("a chart", function()
  it("of bars has heights from 0, upwards and downwards", function()
    local bars = plain("bar", { 1, 2, 4 })
    assert.same({ true, false, true, false, true, false }, inside(bars,
      { { 16.7, 76 }, { 16.7, 74 }, { 50, 51 }, { 50, 49 }, { 83.3, 1 }, { 67.5, 50 } }))
    local both = plain("bar", { 3, -3 })
    assert.same({ true, false, true, false }, inside(both,
      { { 25, 30 }, { 25, 60 }, { 75, 60 }, { 75, 40 } }))
    local pairs_of = plain("bar", { { a = 4, b = 2 } }, { y = { "a", "b" } })
    assert.same({ true, false, true }, inside(pairs_of, { { 30, 10 }, { 70, 10 }, { 70, 60 } }))
  end)

  it("grows from nothing to all with its progress", function()
    for _, kind in ipairs { "bar", "line", "area", "pie" } do
      assert.is_nil(plain(kind, { 1, 2, 4 }, { progress = 0 }):bounds(), kind)
    end
    local data, last = { 3, 5, 4, 6 }, 0
    for i = 1, 8 do
      local _, _, width = plain("line", data, { progress = i / 8 }):bounds()
      assert.is_true(width > last)
      last = width
    end
    local _, y, _, height = plain("bar", { 4 }, { progress = 0.5 }):bounds()
    assert.is_true(y > 5 and y < 50 and math.abs(y + height - 100) < 1e-6)
  end)

  it("of lines leaves out rows without a value, and places numbers where they are", function()
    local line = plain("line", { { x = 0, y = 2 }, { x = 1, y = 2 }, { x = 2 }, { x = 9, y = 2 },
                                 { x = 10, y = 2 } }, { x = "x", y = "y", size = 8 })
    assert.same({ true, false, false, true }, inside(line,
      { { 5, 0.5 }, { 15, 0.5 }, { 85, 0.5 }, { 95, 0.5 } }))
  end)

  it("of areas puts them on one another", function()
    local areas = plain("area", { { a = 1, b = 3 }, { a = 1, b = 3 } },
      { y = { "a", "b" }, colours = { "#f00", "#00f" } })
    local function colour_at(y)
      local r, _, b = celspan.probe(celspan.rostrum { celspan.cel { areas } }, 50, y,
        { film = { 100, 100 } })
      return r > b and "red" or b > r and "blue" or "none"
    end
    assert.same({ "blue", "blue", "red" }, { colour_at(2), colour_at(74), colour_at(76) })
  end)

  it("as a pie has slices as large as their shares, with gaps, and a hole", function()
    local pie = plain("pie", { 1, 1, 2, 0 })
    assert.same({ true, true, true, false, false }, inside(pie,
      { { 70, 30 }, { 70, 70 }, { 20, 50 }, { 50, 20 }, { 80, 50 } }))
    local ring = plain("pie", { 5 }, { hole = 0.5 })
    assert.same({ true, true, false }, inside(ring, { { 50, 10 }, { 50, 90 }, { 50, 40 } }))
    assert.is_nil(plain("pie", { 0, 0 }):bounds())
  end)

  --- Whether the bounds of two objects are apart.
  local function are_apart(a, b)
    local x, y, w, h = a:bounds()
    local left, top, width, height = b:bounds()
    return x >= left + width or left >= x + w or y >= top + height or top >= y + h
  end

  with_art("has no label that covers another, and none outside of its box", function()
    local random, kinds = prng.new(3), { "bar", "line", "area", "pie" }
    for case = 1, 60 do
      local rows, box = {}, { 20, 10, random:between(150, 500), random:between(110, 300) }
      for i = 1, random:whole(1, 40) do
        rows[i] = { name = random:once(2) and i * random:whole(1, 3) + 100 * i
                      or ("n"):rep(random:whole(1, 9)),
                    a = random:between(0, 90), b = random:between(0, 90), c = random:between(0, 9) }
      end
      local kind = random:pick(kinds)
      if kind == "bar" then rows[1].a = -20 end
      local object = chart { kind = kind, data = rows, x = "name", box = box, font = FONT, size = 8,
        y = (kind == "pie" or random:once(2)) and "a" or { "a", "b", "c" }, values = true }
      local texts = {}
      for _, one in ipairs(object) do
        if tostring(one):find "^text" then
          local x, y, w, h = one:bounds()
          assert.is_true(x >= 19.9 and y >= 9.9 and x + w <= box[1] + box[3] + 0.1
            and y + h <= box[2] + box[4] + 0.1, case .. " " .. kind .. ": " .. tostring(one))
          for _, t in ipairs(texts) do
            -- names of bars may be turned by 50 degrees
            assert.is_true(are_apart(one, t) or are_apart(one:rotate(50), t:rotate(50)),
              case .. " " .. kind .. ": " .. tostring(one) .. " covers " .. tostring(t))
          end
          texts[#texts + 1] = one
        end
      end
      assert.is_true(#texts > 0)
    end
  end)

  with_art("writes values as its format does", function()
    local bars = chart { kind = "bar", data = { 3 }, box = { 0, 0, 200, 100 }, font = FONT,
      values = true, axes = false, format = function(value) return ("%g t"):format(value) end }
    assert.equal("3 t", tostring(bars[2][1]))
  end)

  with_art("of a pie are written as its format does, and wrapped where they are long", function()
    local function pie(name)
      local drawn, found = chart { kind = "pie", data = { { n = name, v = 3 }, { n = "b", v = 5 } },
        x = "n", y = "v", box = { 0, 0, 300, 100 }, font = FONT, size = 10,
        format = function(value) return value .. " kg" end }, {}
      for i = 1, #drawn do found[#found + 1] = tostring(drawn[i][1]) end
      return table.concat(found, "\n"), { drawn:bounds() }, { drawn[1]:bounds() }
    end
    assert.matches("b  5 kg", (pie "a"), 1, true)
    local _, whole, circle = pie(("long "):rep(20))
    assert.is_true(whole[1] >= 0 and whole[1] + whole[3] <= 300 and circle[3] >= 55)
  end)

  with_art("of bars stay without axes, if the rows have names", function()
    local function count(x)
      return #chart { kind = "bar", data = { { n = "a", v = 3 }, { n = "b", v = 5 } }, x = x,
        y = "v", box = { 0, 0, 300, 100 }, font = FONT, axes = false }
    end
    assert.are.same({ 3, 1 }, { count "n", count() })
  end)

  it("shows one row, equal values and long tables", function()
    for _, kind in ipairs { "bar", "line", "area", "pie" } do
      assert.is_truthy(plain(kind, { 7 }):bounds() or kind == "area", kind)
      assert.is_truthy(plain(kind, { 7, 7, 7 }):bounds(), kind)
    end
    assert.is_truthy(plain("line", { 0, 0 }):bounds())
    local many = {}
    for i = 1, 100000 do many[i] = { x = i, y = math.sin(i / 9000) } end
    local _, _, width = chart { kind = "line", data = many, x = "x", y = "y",
                                box = { 0, 0, 400, 100 } }:bounds()
    assert.is_true(width > 395)
  end)

  it("refuses what it cannot show", function()
    local long = {}
    for i = 1, 1001 do long[i] = i end
    local function one(changes)
      return function() return plain(changes.kind or "bar", changes.data or { 1 }, changes) end
    end
    raised.each {
      ["chart: needs the field 'kind'"] = function()
        chart { data = { 1 }, box = { 0, 0, 1, 1 } }
      end,
      ['"pie", got "bars"; did you mean "bar"?'] = one { kind = "bars" },
      ["field 'data' must have at least one row"] = one { data = {} },
      ["data[2] must be a finite number, at most 1e12, got nan"] = one { data = { 1, 0 / 0 } },
      ["data[1] must be a finite number, at most 1e12, got inf"] = one { data = { 1 / 0 } },
      ["data[1].v must be a finite number, at most 1e12, got string; csv.read reads numbers with "
        .. "types"] = one { data = { { v = "3" } }, y = "v" },
      ["data[2] must be a row with the field 'v', got number"] = one { data = { { v = 1 }, 2 },
                                                                       y = "v" },
      ["data[1] must be a row with the field 'x', got number"] = one { x = "x" },
      ["data[1].x must be a text or a finite number, at most 1e12, got nil"] = one {
        data = { { v = 1 }, { x = 1 } }, x = "x", y = "v" },
      ["no row of 'data' has a field 'N'; did you mean 'n'?"] = one {
        data = { { day = "Mon", m = 2, n = 3 }, { n = 4 } }, x = "day", y = "N" },
      ["no row of 'data' has a field 'dey'; did you mean 'day'?"] = one {
        data = { { day = "Mon", n = 3 } }, x = "dey", y = "n" },
      ["no row of 'data' has a field 'tons'"] = one {
        data = { { day = "Mon", n = 3 } }, y = { "n", "tons" } },
      ["field 'y' must be the name of a field of the rows, or a list of names"] = one { y = {} },
      ['a chart of the kind "bar" shows at most 1000 rows, got 1001'] = one { data = long },
      ["the box must have a width and a height above 0, got 100 by 0"] = one {
        box = { 0, 0, 100, 0 } },
      ["a pie has no slice for a value below 0, got -2 in row 2"] = one { kind = "pie",
                                                                         data = { 1, -2 } },
      ["a pie shows one field of the rows, got 2 in 'y'"] = one { kind = "pie", y = { "a", "b" },
                                                                 data = { { a = 1, b = 2 } } },
      ["areas on one another have no values below 0, got -1 in row 1 of 'b'"] = one {
        kind = "area", data = { { a = 1, b = -1 } }, y = { "a", "b" } },
      ["field 'hole' must be 0 or more and less than 1, got 1"] = one { hole = 1 },
      ["field 'colours' must have at least one colour"] = one { colours = {} },
    }
  end)

  with_art("refuses a box without room for its labels", function()
    raised.each {
      ["chart: a box of 30 x 20 has no room beside its labels"] = function()
        plain("bar", { 1 }, { box = { 0, 0, 30, 20 }, size = 20, font = FONT, axes = true })
      end,
      ["chart: a box of 30 x 20 has no room beside its names"] = function()
        plain("pie", { 1 }, { box = { 0, 0, 30, 20 }, size = 20, font = FONT })
      end,
    }
  end)
end)

-- ---------------------------------------------------------------- names of bars

describe("the names of bars", function()
  local days = {}
  for i, day in ipairs { "Monday", "Tuesday", "Wednesday", "Thursday", "Friday", "Saturday" } do
    days[i] = { day = day, n = 100 * i }
  end

  --- A chart of the days, and the texts in it, by their words.
  local function written(width, changes)
    local given = { kind = "bar", data = days, x = "day", y = "n", font = FONT, size = 15,
      box = { 10, 10, width, 180 } }
    for name, value in pairs(changes or {}) do given[name] = value end
    local drawn, found = chart(given), {}
    for i = 1, #drawn do
      if tostring(drawn[i]):find "^text" then found[drawn[i][1]] = drawn[i] end
    end
    return found, drawn
  end

  --- Checks that all are there, do not touch and are in the box.
  local function check_names(found, width)
    local before = 10
    for _, row in ipairs(days) do
      local x, y, w, h = found[row.day]:bounds()
      assert.is_true(x >= before and x + w <= 10 + width and y + h <= 190, row.day)
      before = found[row.day].align == "right" and before or x + w
    end
  end

  with_art("are all shown: as they are, smaller, in lines, or turned", function()
    check_names(written(600), 600)
    assert.are.equal(15, written(600).Wednesday.size)
    check_names(written(520), 520)
    assert.is_true(written(520).Wednesday.size < 15)
    check_names(written(260), 260)
    assert.are.equal("right", written(260).Wednesday.align)
    local long = written(330, { data = { { day = "Low tide in spring", n = 1 },
      { day = "The sea in winter", n = 2 }, { day = "Wind from the north", n = 3 } } })
    local _, _, _, h = long["The sea in winter"]:bounds()
    assert.is_true(h > 20)
  end)

  with_art("are beside bars that lie", function()
    local found, drawn = written(300, { lie = true, values = true, most = 800 })
    local x, y, w, h = found.Friday:bounds()
    assert.is_true(x >= 10 and found["500"]:bounds() > x + w)
    local middle = y + h / 2
    assert.is_true(drawn:contains(x + w + 30, middle))
    assert.is_truthy(found["800"])
    assert.is_nil(found["1,000"])
  end)

  with_art("may be highlighted", function()
    local function colour(changes, i)
      local _, drawn = written(600, changes)
      local found = {}
      for k = 1, #drawn do
        local is_bar = tostring(drawn[k]):find "^path" or #drawn[k] == 2 -- pale, on white
        if is_bar and drawn[k]:bounds() then found[#found + 1] = drawn[k] end
      end
      return found[i]
    end
    local pale, strong = colour({ highlight = "max" }, 1), colour({ highlight = "max" }, 2)
    assert.is_true(select(3, pale:bounds()) > 3 * select(3, strong:bounds()))
    assert.is_nil(colour({ highlight = false }, 2))
    raised.each {
      ["field 'highlight' must be \"max\" or a name, got 'Fryday'; did you mean 'Friday'?"] =
        function() written(600, { highlight = "Fryday" }) end,
      ["chart: field 'lie' is of bars"] = function()
        written(600, { kind = "line", lie = true })
      end,
    }
  end)
end)
