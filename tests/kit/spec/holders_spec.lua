-- C code keeps references to the values that it walks: finalisers that remove a constructor's
-- fields while it reads them, lists that callbacks change, values that outlive their parents,
-- errors and yields through C. No freed memory must be used: builds with the address sanitizer
-- detect that when these tests run there.
local celspan = require "celspan"

--- Calls a function while every allocation of Lua collects all garbage, and `change` runs in each
--- collection.
local function pressed(change, call)
  local goes_on = true
  local function again()
    setmetatable({}, { __gc = function()
      if goes_on then
        change()
        again()
      end
    end })
  end
  local mode = collectgarbage("incremental", 1, 1000, 30)
  collectgarbage() -- after it the pause of 0 applies
  again()
  local results = table.pack(pcall(call))
  goes_on = false
  collectgarbage(mode)
  collectgarbage("incremental", 200, 100, 13)
  collectgarbage()
  return table.unpack(results, 1, results.n)
end

--- Removes everything, also from the tables inside.
local function clear(fields)
  for key, value in pairs(fields) do
    fields[key] = nil
    if type(value) == "table" then clear(value) end
  end
end

local function shot(object)
  return celspan.pixels(celspan.rostrum { celspan.cel { object } },
    { size = { 16, 16 }, workers = 1 })
end

local function fade()
  return celspan.linear { from = { 0, 0 }, to = { 9, 9 }, { 0, celspan.rgb(1, 0, 0) },
    { 1, celspan.rgb(0, 0, 1) } }
end

--- New fields, to which there are no other references.
local makers = {
  path = function()
    return { d = "M 1 1 " .. ("L 9 2 L 3 8 "):rep(200 + #tostring(os.clock())),
      texture = celspan.rgb(1, 0, 0) }
  end,
  stroke = function()
    -- Lua allocates twice between reading d and using it, for the dashes and for the colour
    return { d = "M 1 1 " .. ("L 9 2 L 3 8 "):rep(200 + #tostring(os.clock())), dash = { 1, 2 },
      texture = "#ff0000" }
  end,
  rect = function() return { 1, 2, 3, 4, texture = celspan.rgb(1, 0, 0) } end,
  circle = function() return { centre = { 4, 4 }, radius = 3, texture = celspan.rgb(0, 1, 0) } end,
  polygon = function()
    local points = { texture = celspan.rgb(0, 0, 1), rule = "even" .. "odd" }
    for i = 1, 50 do points[i] = { i % 7, i % 11 } end
    return points
  end,
  nurbs = function()
    local points = {}
    for i = 1, 30 do points[i] = { i % 7, i % 11, 1 } end
    return { points = points, degree = 2 }
  end,
  union = function()
    local list = {}
    for i = 1, 40 do list[i] = celspan.rect { i, i, 2, 2 } end
    return list
  end,
  -- the texture of a light is read before its other words, and before the other light
  cel = function()
    local list = { opacity = 0.5,
      front = { texture = fade(), gain = 0.5 + #tostring(os.clock()), on = "c" .. "el" },
      back = fade() }
    for i = 1, 40 do list[i] = celspan.rect { i, i, 2, 2 } end
    return list
  end,
  rostrum = function()
    local list = { brightness = 2 }
    for i = 1, 40 do list[i] = celspan.cel { celspan.rect { i, i, 2, 2 } } end
    return list
  end,
  linear = function()
    local list = { from = { 0, 0 }, to = { 9, 9 } }
    for i = 1, 20 do list[i] = { i / 20, celspan.rgb(i / 20, 0, 0) } end
    return list
  end,
}

describe("fields that are removed while they are read", function()
  for name, make in pairs(makers) do
    it("give a value or an error: " .. name, function()
      for after = 0, 40 do -- collections before they are removed
        local fields, seen = make(), 0
        local done, value = pressed(function()
          seen = seen + 1
          if seen > after then clear(fields) end
        end, function() return celspan[name](fields) end)
        if done then
          assert.are.equal("userdata", type(value))
          assert.are.equal("string", type(tostring(value)))
        else
          assert.are.equal("string", type(value))
        end
      end
    end)
  end

  it("and growing lists give a value or an error", function()
    for _, after in ipairs { 0, 3 } do
      local fields, seen = makers.union(), 0
      local done, value = pressed(function()
        seen = seen + 1
        if seen > after then
          for i = #fields + 1, #fields + 500 do fields[i] = fields[1] end
        end
      end, function() return celspan.union(fields) end)
      assert.are.equal(done and "userdata" or "string", type(value))
    end
  end)
end)

describe("metamethods of a list", function()
  it("are not called", function()
    local function never() error "a metamethod was called" end
    local trap = { __index = never, __len = never, __pairs = never, __newindex = never }
    local points = { { 0, 0 }, { 9, 0 }, { 0, 9 } }
    for _, point in ipairs(points) do setmetatable(point, trap) end
    setmetatable(points, trap)
    assert.are.equal(3, #celspan.polygon(points))
    assert.are.equal(1, #celspan.cel(setmetatable({ celspan.rect { 0, 0, 1, 1 } }, trap)))
    assert.is_false(pcall(celspan.rect, setmetatable({}, { __index = function() return 1 end })))
  end)
end)

describe("callbacks of a render", function()
  local function scanline(spans)
    return celspan.scanline { bounds = { 0, 0, 16, 16 }, spans = spans }
  end

  it("may collect garbage, and change the list that they returned", function()
    local list = {}
    local image = assert(shot(scanline(function(y)
      for i = #list, 1, -1 do list[i] = nil end
      for i = 1, 1 + math.floor(y) % 3 do list[i] = { 4 * i, 4 * i + 2, celspan.rgb(1, 0, 0) } end
      setmetatable(list, { __gc = function(t) clear(t) end })
      collectgarbage()
      return list
    end)))
    assert.are.same({ 1, 0, 0, 1 }, { image:get(5, 0) })
  end)

  it("may render the scene that contains them", function()
    local renders, object = 0, nil
    object = scanline(function()
      if renders < 3 then -- each inside the one before
        renders = renders + 1
        assert(shot(object))
      end
      return { { 0, 8, "#f00" } }
    end)
    local image = assert(shot(object))
    assert.are.same({ 1, 0, 0, 1 }, { image:get(3, 3) })
  end)

  it("stop the render with a sentence if they raise, yield or end coroutines", function()
    local _, message = shot(scanline(function() error { "a table" } end))
    assert.is_truthy(message:find("the error is not a message", 1, true), message)
    local inside = coroutine.wrap(function()
      return shot(scanline(function() coroutine.yield() end))
    end)
    local image
    image, message = inside()
    assert.is_nil(image)
    assert.is_truthy(message:find("yield across a C-call boundary", 1, true), message)
    image, message = shot(scanline(function()
      coroutine.wrap(function() error "in a coroutine" end)()
    end))
    assert.is_nil(image)
    assert.is_truthy(message:find("in a coroutine", 1, true), message)
  end)

  it("may begin in a coroutine that no longer exists when their rows are made", function()
    local object
    coroutine.wrap(function() object = scanline(function() return { { 0, 8, "#f00" } } end) end)()
    collectgarbage()
    local image = assert(shot(object))
    assert.are.same({ 1, 0, 0, 1 }, { image:get(3, 3) })
  end)
end)

describe("a frame", function()
  it("may be kept and used after its film is collected", function()
    local kept
    local rostrum = celspan.film { size = { 8, 8 }, frames = 3, frame = function(f)
      kept = f
      collectgarbage()
      return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 4, 4, texture = "#f00" } } }
    end }:at(1)
    collectgarbage()
    collectgarbage()
    assert.are.equal(1, kept.number)
    assert.are.equal("number", type(kept:random("x")))
    assert.are.equal(kept.index, kept:on(1))
    assert.are.same({ 1, 0, 0, 1 },
      { assert(celspan.pixels(rostrum, { size = { 8, 8 } })):get(1, 1) })
  end)

  it("is complete if it is built while everything is collected", function()
    local film = celspan.film { size = { 8, 8 }, frames = 3, frame = function()
      return celspan.rostrum {
        celspan.cel { celspan.rect { 0, 0, 4, 4, texture = celspan.rgb(1, 0, 0) } } }
    end }
    local done, image = pressed(function() end, function()
      return assert(celspan.pixels(film:at(2), { size = { 8, 8 } }))
    end)
    assert.is_true(done, image)
    assert.are.same({ 1, 0, 0, 1 }, { image:get(1, 1) })
  end)
end)
