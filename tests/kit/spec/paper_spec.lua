-- The paper's claims about spans, light and filters, each by itself; docs/paper.md quotes them.
local celspan = require "celspan"

--- The one row of a rostrum `width` pixels wide.
local function row(rostrum, width)
  return assert(celspan.spans(rostrum, { size = { width, 1 }, film = { width, 1 } }))[0]
end

local function sharp(...)
  return celspan.rostrum { antialias = "none", celspan.cel { ... } }
end

--- The kinds of the spans in a row, "single gradient ...".
local function kinds(spans)
  local names = {}
  for i, span in ipairs(spans) do names[i] = span.kind end
  return table.concat(names, " ")
end

local function bar(x0, x1, texture) return celspan.rect { x0, 0, x1 - x0, 1, texture = texture } end

--- A horizontal gradient of the columns from x0 to x1.
local function gradient(x0, x1, from, to)
  return celspan.linear { from = { x0, 0 }, to = { x1, 0 }, { 0, from }, { 1, to } }
end

local function noise(count)
  local bytes = {}
  for i = 1, 4 * count do bytes[i] = string.char(i * 73 % 256) end
  return celspan.picture { pixels = table.concat(bytes), size = { count, 1 }, format = "rgba8" }
end

describe("figure 6", function()
  it("is a row of three spans for 24 pixels", function()
    local spans = row(sharp(bar(0, 7, "#2a7f86"), bar(7, 15, gradient(7, 15, "#dba23a", "#c4472f")),
      bar(15, 24, noise(9))), 24)
    assert.are.equal("single gradient array", kinds(spans))
    assert.are.same({ 7, 15, 24 }, { spans[1].x1, spans[2].x1, spans[3].x1 })
    assert.are.equal(4 * 9, #spans[3])
  end)
end)

describe("Table 1", function()
  local glass = celspan.rgb(0.8, 0.2, 0.1, 0.5)
  local textures = {
    single = glass,
    gradient = gradient(0, 64, celspan.rgb(0.8, 0.2, 0.1, 0.5), celspan.rgb(0.1, 0.4, 0.9, 0.5)),
    array = noise(64),
  }
  local order = { single = 1, gradient = 2, array = 3 }
  for front, front_texture in pairs(textures) do
    for back, back_texture in pairs(textures) do
      it(("makes %s over %s a span of the richer kind"):format(front, back), function()
        local expected = order[front] > order[back] and front or back
        local spans = row(sharp(bar(0, 64, back_texture), bar(0, 64, front_texture)), 64)
        assert.are.equal(expected, kinds(spans))
      end)
    end
  end

  it("divides a gradient over a gradient where their product bends", function()
    local veil = gradient(0, 2048, celspan.rgb(1, 0, 0, 0), celspan.rgb(1, 0, 0, 1))
    local spans = row(sharp(bar(0, 2048, gradient(0, 2048, "#000000", "#ffffff")),
      bar(0, 2048, veil)), 2048)
    assert.is_true(#spans > 1)
    for _, span in ipairs(spans) do assert.equal("gradient", span.kind) end
  end)

  it("has pixels where the pieces of such a product would be short", function()
    local veil = gradient(0, 64, celspan.rgb(1, 0, 0, 0), celspan.rgb(1, 0, 0, 1))
    local back = bar(0, 64, gradient(0, 64, "#000000", "#ffffff"))
    assert.equal("array", kinds(row(sharp(back, bar(0, 64, veil)), 64)))
  end)
end)

describe("figure 7", function()
  it("keeps the columns that both lists have", function()
    local a = celspan.union { bar(2, 13, "#ff0000"), bar(17, 27, "#00ff00") }
    local b = celspan.union { bar(0, 5, "#0000ff"), bar(8, 21, "#0000ff"), bar(24, 30, "#0000ff") }
    local columns = {}
    for _, span in ipairs(row(sharp(a & b), 30)) do
      if span[4] > 0 then columns[#columns + 1] = { span.x0, span.x1 } end
    end
    assert.are.same({ { 2, 5 }, { 8, 13 }, { 17, 21 }, { 24, 27 } }, columns)
  end)
end)

describe("figure 9", function()
  --- The columns of a row with one colour of light.
  local function columns(spans, r, g, b)
    local list = {}
    for _, span in ipairs(spans) do
      if span[1] == r and span[2] == g and span[3] == b and span[4] == 1 then
        list[#list + 1] = { span.x0, span.x1 }
      end
    end
    return list
  end

  it("shows a primitive only inside the mask, and both hide the background", function()
    local leaf = celspan.union { bar(9, 26, "#ff0000"), bar(32, 54, "#ff0000") }
    local mask = celspan.union { bar(12, 20, "#00ff00"), bar(43, 48, "#00ff00") }
    local spans = row(sharp(bar(0, 60, "#0000ff"), leaf, mask), 60)
    assert.are.same(columns(row(sharp(leaf - mask), 60), 1, 0, 0), columns(spans, 1, 0, 0))
    assert.are.same({ { 0, 9 }, { 26, 32 }, { 54, 60 } }, columns(spans, 0, 0, 1))
  end)
end)

describe("the lighting operator", function()
  it("is beta P F + (1 - beta) M B, cel by cel", function()
    local cels, light = {}, { 0, 0, 0 }
    for i = 1, 5 do
      local function number(label) return celspan.random("lights")(label .. i) end
      local pigment, medium = { number "p1", number "p2", number "p3" },
        { number "m1", number "m2", number "m3" }
      local front, back = { number "f1", number "f2", number "f3" },
        { number "b1", number "b2", number "b3" }
      local beta = number "beta"
      for c = 1, 3 do
        light[c] = beta * pigment[c] * front[c] + (1 - beta) * medium[c] * (light[c] + back[c])
      end
      local paint = celspan.paint { pigment = pigment, medium = medium, beta = beta }
      cels[i] = celspan.cel { bar(0, 1, paint), front = front,
        back = { back[1], back[2], back[3], 0 } }
    end
    cels.antialias = "none"
    local span = row(celspan.rostrum(cels), 1)[1]
    for c = 1, 3 do assert.near(light[c], span[c], 1e-5) end
  end)
end)

describe("figure 11", function()
  local function list(defocus)
    local art = celspan.union { bar(-9, 7, celspan.rgb(0.2, 0.2, 0.2)),
      bar(7, 15, celspan.rgb(0.9, 0.9, 0.9)),
      bar(15, 31, celspan.rgb(0.45, 0.45, 0.45)) }
    return row(celspan.rostrum { antialias = "none",
      celspan.cel { art:scale(1, 30, 0, 0.5), defocus = defocus } }, 22)
  end

  it("filters 3 spans into 5 by a box", function()
    assert.are.equal("single single single", kinds(list()))
    assert.are.equal("single gradient single gradient single",
      kinds(list { radius = 2.5, kernel = "box" }))
  end)

  it("has ramps as long as the box is wide, around each step", function()
    local spans = list { radius = 2.5, kernel = "box" }
    assert.are.same({ 5, 10, 13, 18, 22 },
      { spans[1].x1, spans[2].x1, spans[3].x1, spans[4].x1, spans[5].x1 })
    assert.near(0.2 + 0.7 * 1 / 5, spans[2][1], 1e-6)
    assert.near(0.9, spans[2][5], 1e-6)
  end)
end)

describe("a filter", function()
  it("weighs colours by their alpha", function()
    local half = celspan.rostrum { celspan.cel { bar(0, 0.5, celspan.rgb(1, 0, 0, 0.25)),
      bar(0.5, 1, celspan.rgb(0, 1, 0, 0.75)) } }
    local span = row(half, 1)[1]
    assert.near(0.125, span[1], 1e-6)
    assert.near(0.375, span[2], 1e-6)
    assert.near(0.5, span[4], 1e-6)
  end)

  it("weighs pigment by beta and medium by 1 - beta in a defocused cel", function()
    local red = celspan.paint { pigment = { 1, 0, 0 }, medium = { 0.5, 1, 1 }, beta = 0.5 }
    local gel = celspan.gel(1, 0.2, 1)
    local art = celspan.union { celspan.rect { -50, -50, 50, 101, texture = red },
      celspan.rect { 0, -50, 51, 101, texture = gel } }
    local rostrum = celspan.rostrum { antialias = "none",
      celspan.cel { art, defocus = { radius = 4, kernel = "box" }, back = { 1, 1, 1, 0 } } }
    local r, g, b = table.unpack(row(rostrum:with { camera = { centre = { 0, 0.5 } } }, 1)[1])
    assert.near((0.5 + 0.25 + 1) / 2, r, 0.07)
    assert.near((0.5 + 0.2) / 2, g, 0.07)
    assert.near((0.5 + 1) / 2, b, 0.07)
  end)
end)
