-- celspan.composite: the operators of Porter and Duff.
local celspan = require "celspan"
local images = require "tests.support.images"

local function square(r, g, b, a)
  return celspan.rect { 0, 0, 1, 1, texture = celspan.rgb(r, g, b, a) }
end

local function seen(object)
  local rostrum = celspan.rostrum { celspan.cel { object } }
  local image = assert(celspan.pixels(rostrum, { size = { 1, 1 } }))
  images.near({ celspan.probe(rostrum, 0.5, 0.5, { film = { 1, 1 } }) }, image, 0, 0)
  return image
end

describe("two objects are composited", function()
  it("and the modes of other programs' nodes are those that messages name", function()
    local a, b = square(0.75, 0.75, 0.75), square(0.5, 0.5, 0.5)
    for node, value in pairs { minus = 0.25, from = 0, plus = 1.25, max = 0.75, min = 0.5 } do
      local _, message = pcall(celspan.composite, a, b, node)
      local advice = message:match "write (.*)$"
      local front = load("local a, b = ... return " .. advice)(a, b)
      local rear = advice:sub(1, 1) == "a" and b or a
      images.near({ value, value, value, 1 }, seen(celspan.group { rear, front }), 0, 0)
    end
  end)

  -- how much of the source and of the backdrop stays, by the alphas of both: Porter and Duff, 1984
  local shares = {
    over = function(a) return 1, 1 - a end,
    ["in"] = function(_, b) return b, 0 end,
    out = function(_, b) return 1 - b, 0 end,
    atop = function(a, b) return b, 1 - a end,
    xor = function(a, b) return 1 - b, 1 - a end,
  }
  for operator, share in pairs(shares) do
    it(("by %q"):format(operator), function()
      for _, alphas in ipairs { { 1, 1 }, { 0.25, 0.75 }, { 1, 0.25 }, { 0.75, 1 } } do
        local a, b = alphas[1], alphas[2]
        local of_a, of_b = share(a, b)
        local source, backdrop = square(1, 0.5, 0, a), square(0, 0.25, 1, b)
        local image = seen(celspan.composite(source, backdrop, operator))
        images.near({ of_a * a, 0.5 * of_a * a + 0.25 * of_b * b, of_b * b, of_a * a + of_b * b },
          image, 0, 0)
      end
    end)
  end

  it("inside each other, apart from the backdrop of the whole", function()
    local ring = celspan.composite(square(1, 1, 1, 0.5), square(0, 0, 0, 0.5), "xor")
    local image = seen(celspan.group { square(0, 0, 1), celspan.composite(ring, square(1, 0, 0),
      "in") })
    images.near({ 0.25, 0.25, 0.75, 1 }, image, 0, 0)
  end)

  it("and nodes of other compositors lead to what is written here", function()
    for node, advice in pairs { erode = "grow = %-1", keymix = "celspan.matte%(a, mask%)",
        multiply = 'a:blend "multiply"', premult = 'alpha = "straight"',
        over = "celspan.composite", chromakey = "celspan.key" } do
      assert.error_matches(function() return celspan[node] end,
        ("celspan has no '%s'; write .*%s"):format(node, advice))
    end
    local a, mask = square(1, 1, 1), square(1, 1, 1, 0.5)
    for _, node in ipairs { "keymix", "hold-out", "matte" } do
      local _, message = pcall(celspan.composite, a, a, node)
      local value = load("local celspan, a, b, mask = ... return " .. message:match "write (.*)$")
      assert.equal("number", math.type(seen(value(celspan, a, a, mask)):get(0, 0)) and "number")
    end
  end)

  it("and other operators are refused with what to write", function()
    local a = square(1, 1, 1)
    assert.error_matches(function() celspan.composite(a, a, "stencil") end,
      'got "stencil"; write celspan.composite%(b, a, "out"%)')
    assert.error_matches(function() celspan.composite(a, a, "dilate") end,
      'got "dilate"; write celspan.matte%(art, by, { grow = 1 }%)')
    assert.error_matches(function() celspan.composite(a, a) end, '"in".*got nil')
    assert.error_matches(function() celspan.composite(a, 3, "in") end, "argument 2 must be")
    assert.error_matches(function() celspan.composite(nil, a, "in") end, "argument 1 must be")
  end)
end)
