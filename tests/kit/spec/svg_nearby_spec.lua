-- feConvolveMatrix, the lighting filters and functions of alpha beside their formulas, written
-- again, and beside Chromium.
local filtered = require "tests.support.filtered"
local present = require "tests.support.present"

local in_browser = present.program "chromium" and it or pending
local W, H = filtered.width, filtered.height
local LIGHT = 'x="0" y="0" width="120" height="100" filterUnits="userSpaceOnUse"'
local CODES = LIGHT .. ' color-interpolation-filters="sRGB"'
local HEAD = '<svg xmlns="http://www.w3.org/2000/svg" width="120" height="100"%s>'

local function draw(text)
  local image, left_out = filtered.draw(text)
  assert.equal("", left_out)
  return image
end

-- ---------------------------------------------------------------- the formulas

--- Rectangles of whole pixels, some of them translucent, with a filter.
local function blocks(steps, filter)
  return HEAD:format("") .. ('<filter id="f" %s>%s</filter><g filter="url(#f)">'):format(
    filter or LIGHT, steps) .. '<rect x="20" y="16" width="50" height="40" fill="#f84"/>'
    .. '<rect x="60" y="40" width="40" height="50" fill="#26a" fill-opacity=".6"/>'
    .. '<rect x="0" y="60" width="30" height="40" fill="#4c2" fill-opacity=".3"/></g></svg>'
end

--- The light of a drawing's pixels; `edges`: what a place outside means, as a place inside or nil.
local function samples_of(text, edges)
  local image, clear = draw(text), { 0, 0, 0, 0 }
  return function(x, y)
    x, y = edges(x, W), edges(y, H)
    return x and y and { image:get(x, y) } or clear
  end
end

local edges = {
  duplicate = function(at, size) return math.max(0, math.min(at, size - 1)) end,
  wrap = function(at, size) return at % size end,
  none = function(at, size) return at >= 0 and at < size and at or nil end,
}

local function held(value, least, most) return math.max(least, math.min(value, most)) end

--- Compares every third pixel of a drawing with a function of its column and row.
local function assert_pixels(text, wanted, within)
  local image = draw(text)
  for y = 0, H - 1, 3 do
    for x = (y // 3) % 2, W - 1, 3 do
      local found, right = { image:get(x, y) }, wanted(x, y)
      for c = 1, 4 do
        assert.is_true(math.abs(found[c] - right[c]) < (within or 6e-4),
          ("channel %d at %d, %d: %g instead of %g"):format(c, x, y, found[c], right[c]))
      end
    end
  end
end

local function summed(given, samples, x, y)
  local columns, rows = given.order[1], given.order[2]
  local sum, divisor = { 0, 0, 0, 0 }, 0
  for _, value in ipairs(given.matrix) do divisor = divisor + value end
  divisor = given.divisor or divisor ~= 0 and divisor or 1
  local tx = given.target and given.target[1] or columns // 2
  local ty = given.target and given.target[2] or rows // 2
  for i = 0, rows - 1 do
    for j = 0, columns - 1 do
      local from = samples(x - tx + j, y - ty + i)
      local weight = given.matrix[(rows - i - 1) * columns + columns - j] / divisor
      for c = 1, 4 do
        local share = given.keeps and c < 4 and (from[4] > 0 and 1 / from[4] or 0) or 1
        sum[c] = sum[c] + weight * share * from[c]
      end
    end
  end
  for c = 1, 4 do sum[c] = sum[c] + (given.bias or 0) end
  return sum
end

local function convolved(given, samples, x, y)
  local sum = summed(given, samples, x, y)
  local alpha = given.keeps and samples(x, y)[4] or held(sum[4], 0, 1)
  for c = 1, 3 do
    sum[c] = given.keeps and alpha * held(sum[c], 0, 1) or held(sum[c], 0, alpha)
  end
  sum[4] = alpha
  return sum
end

local function unit(x, y, z)
  local length = math.sqrt(x * x + y * y + z * z)
  return { x / length, y / length, z / length }
end

local function dot(a, b) return a[1] * b[1] + a[2] * b[2] + a[3] * b[3] end

--- The slope of alpha inside the picture, by the table of the specification.
local function normal_of(samples, x, y, height)
  local function alpha(dx, dy) return samples(x + dx, y + dy)[4] end
  local across = alpha(1, -1) + 2 * alpha(1, 0) + alpha(1, 1)
    - alpha(-1, -1) - 2 * alpha(-1, 0) - alpha(-1, 1)
  local down = alpha(-1, 1) + 2 * alpha(0, 1) + alpha(1, 1)
    - alpha(-1, -1) - 2 * alpha(0, -1) - alpha(1, -1)
  return unit(-height * across / 4, -height * down / 4, 1)
end

local function lit(given, samples, x, y)
  local normal, to = normal_of(samples, x, y, given.height), given.direction
  local colour, share = given.colour or { 1, 1, 1 }, 1
  if given.at then
    to = unit(given.at[1] - x - 0.5, given.at[2] - y - 0.5,
      given.at[3] - given.height * samples(x, y)[4])
  end
  if given.towards then
    local axis = unit(given.towards[1] - given.at[1], given.towards[2] - given.at[2],
      given.towards[3] - given.at[3])
    share = math.max(0, -dot(axis, to)) ^ given.focus
  end
  local bright = math.max(0, dot(normal, to))
  if given.exponent then
    bright = math.max(0, dot(normal, unit(to[1], to[2], to[3] + 1))) ^ given.exponent
  end
  local out = {}
  for c = 1, 3 do out[c] = held(given.constant * bright * share * colour[c], 0, 1) end
  out[4] = given.exponent and math.max(out[1], out[2], out[3]) or 1
  return out
end

describe("filters of neighbours", function()
  it("sum the matrix of feConvolveMatrix", function()
    for _, given in ipairs {
      { order = { 3, 3 }, matrix = { 1, 2, 3, 4, 5, 6, 7, 8, 9 } },
      { order = { 3, 3 }, matrix = { 0, -1, 0, -1, 5, -1, 0, -2, 0 }, keeps = true },
      { order = { 4, 2 }, matrix = { 1, 0, 2, 0, 0, 3, 0, -1 }, divisor = 4, edge = "none" },
      { order = { 5, 1 }, matrix = { 1, 0, 0, 0, 2 }, target = { 4, 0 }, edge = "wrap" },
      { order = { 1, 7 }, matrix = { 1, 1, 1, 1, 1, 1, 9 }, target = { 0, 1 } },
      { order = { 3, 3 }, matrix = { -1, -1, -1, -1, 8, -1, -1, -1, -1 }, bias = 0.25 },
    } do
      local edge = given.edge or "duplicate"
      local step = ('<feConvolveMatrix order="%d %d" kernelMatrix="%s" edgeMode="%s"%s%s%s%s/>')
        :format(given.order[1], given.order[2], table.concat(given.matrix, " "), edge,
        given.keeps and ' preserveAlpha="true"' or "",
        given.divisor and (' divisor="%g"'):format(given.divisor) or "",
        given.bias and (' bias="%g"'):format(given.bias) or "",
        given.target and (' targetX="%d" targetY="%d"'):format(table.unpack(given.target)) or "")
      local samples = samples_of(blocks "<feMerge><feMergeNode/></feMerge>", edges[edge])
      assert_pixels(blocks(step), function(x, y) return convolved(given, samples, x, y) end)
    end
  end)

  it("light alpha as a height", function()
    local blur = '<feGaussianBlur stdDeviation="2"/>'
    local samples = samples_of(blocks(blur), edges.duplicate)
    local turn, rise = math.rad(30), math.rad(40)
    local direction = { math.cos(turn) * math.cos(rise), math.sin(turn) * math.cos(rise),
      math.sin(rise) }
    for step, given in pairs {
      ['<feDiffuseLighting surfaceScale="4" diffuseConstant=".8"><feDistantLight azimuth="30" '
        .. 'elevation="40"/></feDiffuseLighting>'] = { height = 4, constant = 0.8,
        direction = direction },
      ['<feSpecularLighting surfaceScale="-6" specularConstant="1.2" specularExponent="7" '
        .. 'lighting-color="#f00"><feDistantLight azimuth="30" elevation="40"/>'
        .. '</feSpecularLighting>'] = { height = -6, constant = 1.2, exponent = 7,
        direction = direction, colour = { 1, 0, 0 } },
      ['<feDiffuseLighting surfaceScale="9"><fePointLight x="30" y="70" z="25"/>'
        .. '</feDiffuseLighting>'] = { height = 9, constant = 1, at = { 30, 70, 25 } },
      ['<feSpecularLighting specularExponent="3"><feSpotLight x="70" y="20" z="50" pointsAtX="40" '
        .. 'pointsAtY="60" specularExponent="5"/></feSpecularLighting>'] = { height = 1,
        constant = 1, exponent = 3, at = { 70, 20, 50 }, towards = { 40, 60, 0 }, focus = 5 },
    } do
      local whole = draw(blocks(blur .. step))
      assert_pixels(blocks(blur .. step), function(x, y)
        local edge = x == 0 or y == 0 or x == W - 1 or y == H - 1
        return edge and { whole:get(x, y) } or lit(given, samples, x, y)
      end, 5e-3) -- lines between samples are within a quarter of 1/1023; slopes enlarge this
    end
  end)

  it("change alpha by a function of it, where there is nothing, too", function()
    local samples = samples_of(blocks "<feMerge><feMergeNode/></feMerge>", edges.none)
    local function with(f, ground)
      return function(x, y)
        local from, out = samples(x, y), {}
        local alpha = f(from[4])
        for c = 1, 3 do
          out[c] = from[4] > 0 and from[c] / from[4] * alpha or ground[c] * alpha
        end
        out[4] = alpha
        return out
      end
    end
    local function transfer(functions)
      return blocks("<feComponentTransfer>" .. functions .. "</feComponentTransfer>")
    end
    assert_pixels(transfer '<feFuncA type="linear" slope=".5" intercept=".25"/>',
      with(function(a) return a / 2 + 0.25 end, { 0, 0, 0 }))
    assert_pixels(transfer '<feFuncA type="gamma" exponent="2"/>',
      with(function(a) return a * a end, { 0, 0, 0 }))
    assert_pixels(blocks '<feColorMatrix values="1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 0 -1 1"/>',
      with(function(a) return 1 - a end, { 0, 0, 0 }))
    assert_pixels(transfer '<feFuncA type="table" tableValues="1 0 1"/>',
      with(function(a) return math.abs(1 - 2 * a) end, { 0, 0, 0 }))
    local r, g, b, a = draw(transfer('<feFuncG type="linear" intercept=".5"/>'
      .. '<feFuncA type="linear" slope="0" intercept="1"/>')):get(110, 5)
    assert.is_true(r == 0 and math.abs(g - 0.5) < 1e-3 and b == 0 and a == 1)
  end)

  it("follow transforms: a unit of the element is a pixel of the matrix", function()
    local step = '<filter id="f" filterUnits="userSpaceOnUse" width="120" height="100">'
      .. '<feConvolveMatrix order="3 1" kernelMatrix="0 0 1"/></filter>'
      .. '<g%s><rect x="10" y="10" width="20" height="20" filter="url(#f)"/></g></svg>'
    local plain = draw(HEAD:format "" .. step:format "")
    local large = draw(HEAD:format "" .. step:format ' transform="scale(2)"')
    local zoomed = draw(HEAD:format ' viewBox="0 0 60 50"' .. step:format "")
    local function is_there(image, x, y) return select(4, image:get(x, y)) > 0.99 end
    assert.is_true(is_there(plain, 11, 15) and not is_there(plain, 10, 15))
    for _, image in ipairs { large, zoomed } do
      assert.is_true(is_there(image, 24, 30) and is_there(image, 59, 30))
      assert.is_false(is_there(image, 19, 30) or is_there(image, 64, 30))
    end
  end)

  it("have numbers in shares of the element's box", function()
    local box = 'x="0" y="0" width="1" height="1" primitiveUnits="objectBoundingBox"'
    local light = '<feDiffuseLighting><fePointLight x="%g" y="%g" z="%g"/></feDiffuseLighting>'
    local function lamp(filter, ...)
      return draw(HEAD:format "" .. ('<filter id="f" %s>%s</filter><rect x="20" y="10" width="60" '
        .. 'height="80" filter="url(#f)"/></svg>'):format(filter, light:format(...))):bytes()
    end
    local shares = lamp(box, 0.5, 0.25, 0.5)
    assert.equal(shares, lamp('x="0" y="0" width="1" height="1"', 50, 30,
      0.5 * math.sqrt((60 ^ 2 + 80 ^ 2) / 2)))
    assert.is_false(shares == lamp(box, 0.5, 0.25, 0.4))
  end)

  it("are listed and left out, if their numbers make no sense", function()
    for step, what in pairs {
      ['<feConvolveMatrix kernelMatrix="1 2 3"/>'] = "feConvolveMatrix with such a kernelMatrix",
      ['<feConvolveMatrix/>'] = "feConvolveMatrix with such a kernelMatrix",
      ['<feConvolveMatrix order="0" kernelMatrix=""/>'] = "feConvolveMatrix with such an order",
      ['<feConvolveMatrix order="1.5" kernelMatrix="1"/>'] = "feConvolveMatrix with such an order",
      ['<feConvolveMatrix order="x" kernelMatrix="1"/>'] = "feConvolveMatrix with such an order",
      ['<feConvolveMatrix order="1e12" kernelMatrix="1"/>'] = "feConvolveMatrix with such an order",
      ['<feConvolveMatrix order="1000" kernelMatrix="1"/>'] =
        "feConvolveMatrix with more than 1,024 numbers",
      ['<feConvolveMatrix order="2" targetX="2" kernelMatrix="1 1 1 1"/>'] =
        "feConvolveMatrix with such a target",
      ["<feDiffuseLighting/>"] = "feDiffuseLighting without a light source",
      ["<feSpecularLighting><feFlood/></feSpecularLighting>"] =
        "feSpecularLighting without a light source",
    } do
      local art = filtered.read(blocks(step))
      assert.equal("filter of g: " .. what, art.skipped[1].what)
      local plain = draw(blocks "<feMerge><feMergeNode/></feMerge>")
      assert.equal(filtered.image { art.object }:bytes(), plain:bytes())
    end
  end)

  it("are drawn whatever the numbers of a light are", function()
    for _, light in ipairs { "<feDistantLight/>", '<feDistantLight azimuth="1e12" elevation="-9"/>',
      "<fePointLight/>", '<fePointLight x="60" y="50" z="1"/>', "<feSpotLight/>",
      '<feSpotLight z="1e9" specularExponent="1e9" limitingConeAngle="0"/>' } do
      for _, name in ipairs { "feDiffuseLighting", "feSpecularLighting" } do
        draw(blocks(('<%s surfaceScale="1e9" specularExponent="-4">%s</%s>'):format(name, light,
          name)))
      end
    end
    draw(blocks('<feConvolveMatrix order="32" kernelMatrix="' .. ("1e9 "):rep(1024) .. '"/>'))
    draw(blocks('<feConvolveMatrix order="1024 1" kernelMatrix="' .. ("1 "):rep(1024) .. '"/>'))
  end)

  -- -------------------------------------------------------------- Chromium

  local BLUR = '<feGaussianBlur in="SourceAlpha" stdDeviation="3"/>'
  local function matrix(attributes) return ("<feConvolveMatrix %s/>"):format(attributes) end
  local function alpha(f, others)
    return ("<feComponentTransfer>%s<feFuncA %s/></feComponentTransfer>"):format(others or "", f)
  end
  local ONES = "1 1 1 1 1 1 1"
  local PART = 'x="20" y="20" width="60" height="50" '
  local cases = {
    feConvolveMatrix = {
      { matrix 'kernelMatrix="1 1 1 1 1 1 1 1 1"' },
      { matrix 'kernelMatrix="1 1 1 1 1 1 1 1 1"', CODES },
      { matrix 'kernelMatrix="0 -1 0 -1 5 -1 0 -1 0"', CODES },
      { matrix 'kernelMatrix="0 -1 0 -1 8 -1 0 -1 0" preserveAlpha="true"', CODES },
      { matrix 'kernelMatrix="-1 -1 -1 -1 8 -1 -1 -1 -1" preserveAlpha="true"', CODES },
      { matrix 'kernelMatrix="-2 -1 0 -1 1 1 0 1 2" preserveAlpha="true"', CODES },
      { matrix('order="5" kernelMatrix="' .. ("1 "):rep(25) .. '"') },
      { matrix 'order="5 1" kernelMatrix="1 2 3 4 5"', CODES },
      { matrix 'order="1 5" kernelMatrix="5 0 0 0 1"', CODES },
      { matrix 'order="4" kernelMatrix="1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"' },
      { matrix 'order="3 2" targetX="0" targetY="1" kernelMatrix="3 0 0 0 0 1"', CODES },
      { matrix 'kernelMatrix="1 2 1 2 4 2 1 2 1" divisor="20"', CODES },
      { matrix 'kernelMatrix="1 2 1 2 4 2 1 2 1" divisor="10"' },
      { matrix('order="7 1" kernelMatrix="' .. ONES .. '" edgeMode="none"') },
      { matrix('order="7 1" kernelMatrix="' .. ONES .. '" edgeMode="wrap"'), CODES },
      { matrix('order="7 1" kernelMatrix="' .. ONES .. '" ' .. PART), CODES },
      { matrix('order="7 1" kernelMatrix="' .. ONES .. '" edgeMode="none" preserveAlpha="true" '
        .. PART), CODES },
      { matrix 'in="SourceAlpha" kernelMatrix="1 1 1 1 -7 1 1 1 1"', CODES },
      { matrix 'kernelMatrix="1 1 1 1 1 1 1 1 1" bias=".2" preserveAlpha="true"', CODES },
      { matrix 'kernelMatrix="1 1 1 1 1 1 1 1 1" bias=".2"', CODES },
    },
    feFuncA = {
      { alpha 'type="linear" slope="2"' },
      { alpha 'type="linear" slope=".5" intercept=".5"', CODES },
      { alpha 'type="table" tableValues="1 0"', CODES },
      { alpha 'type="table" tableValues="0 1 0"' },
      { alpha 'type="discrete" tableValues="0 1"', CODES }, { alpha 'type="gamma" exponent="3"' },
      { alpha 'type="gamma" amplitude=".5" exponent=".3" offset=".3"', CODES },
      { BLUR .. alpha 'type="discrete" tableValues="0 .5 1"', CODES },
      { BLUR .. alpha 'type="linear" slope="9" intercept="-4"' },
      { BLUR .. alpha 'type="linear" slope="9" intercept="-4"', CODES },
      { BLUR .. alpha 'type="table" tableValues="0 0 1 1"', CODES },
      { BLUR .. alpha 'type="table" tableValues="0 1 0"', CODES },
      { BLUR .. alpha 'type="linear" slope="-1" intercept="1"', CODES },
      { alpha('type="linear" slope="0" intercept="1"',
        '<feFuncR type="linear" slope=".5" intercept=".5"/>'), CODES },
      { alpha('type="table" tableValues=".3 1"', '<feFuncG type="table" tableValues="1 0"/>') },
      { alpha('type="gamma" exponent=".4"', '<feFuncB type="discrete" tableValues="0 .5 1"/>'),
        CODES },
      { '<feColorMatrix values="1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 0 18 -7"/>', CODES },
      { BLUR .. '<feColorMatrix values="1 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 0 9 -4"/>' },
      { '<feColorMatrix values="0 1 0 0 0 1 0 0 0 .2 0 0 1 0 0 0 0 0 .5 .5"/>', CODES },
      { BLUR .. '<feColorMatrix values="0 0 0 0 1 0 0 0 0 .5 0 0 0 0 0 0 0 0 -1 1"/>', CODES },
    },
    feDiffuseLighting = {}, feSpecularLighting = {},
  }
  -- what is lit, the attributes, the source of light, what follows, the filter
  local lights = {
    { BLUR, 'surfaceScale="3"', '<feDistantLight azimuth="45" elevation="50"/>' },
    { BLUR, 'surfaceScale="3"', '<feDistantLight azimuth="45" elevation="50"/>', "", CODES },
    { BLUR, 'surfaceScale="-2" lighting-color="#fc8"', '<feDistantLight azimuth="200" '
      .. 'elevation="60"/>' },
    { BLUR, 'surfaceScale="1" constant="1.5"', '<feDistantLight azimuth="270" elevation="40"/>', "",
      CODES },
    { "", 'in="SourceAlpha" surfaceScale="2"', '<feDistantLight azimuth="135" elevation="45"/>', "",
      CODES },
    { "", "", '<feDistantLight elevation="60"/>' },
    { BLUR, 'surfaceScale="2"', '<fePointLight x="60" y="50" z="60"/>' },
    { BLUR, 'surfaceScale="3" lighting-color="#8cf"', '<fePointLight x="10" y="10" z="80"/>', "",
      CODES },
    { BLUR, 'surfaceScale="2" constant=".7"', '<fePointLight x="110" y="90" z="60"/>' },
    { "", 'surfaceScale="1"', '<fePointLight x="60" y="50" z="200"/>', "", CODES },
    { BLUR, 'surfaceScale="2"', '<feSpotLight x="20" y="20" z="60" pointsAtX="80" pointsAtY="60"/>',
      "", CODES },
    { BLUR, 'surfaceScale="3"', '<feSpotLight x="60" y="-20" z="60" pointsAtX="60" pointsAtY="60" '
      .. 'specularExponent="8"/>', "", CODES },
    { BLUR, 'surfaceScale="5" lighting-color="#ff0"', '<feSpotLight x="60" y="50" z="80" '
      .. 'pointsAtX="60" pointsAtY="50" limitingConeAngle="20"/>', "", CODES },
    { BLUR, 'surfaceScale="5" lighting-color="#ff0"', '<feSpotLight x="60" y="50" z="80" '
      .. 'pointsAtX="40" pointsAtY="50" limitingConeAngle="-25" specularExponent="3"/>' },
    { BLUR, 'surfaceScale="5" ' .. PART, '<feDistantLight azimuth="45" elevation="50"/>', "",
      CODES },
    { BLUR, 'surfaceScale="4" result="l"', '<feDistantLight azimuth="45" elevation="50"/>',
      '<feComposite in="l" in2="SourceAlpha" operator="in"/>', CODES },
    { BLUR, 'surfaceScale="3" result="l"', '<feDistantLight azimuth="225" elevation="50"/>',
      '<feBlend in="SourceGraphic" in2="l" mode="multiply"/>', CODES },
    { '<feTurbulence type="fractalNoise" baseFrequency=".04" numOctaves="3"/>',
      'surfaceScale="4" lighting-color="#fec"', '<feDistantLight azimuth="45" elevation="60"/>', "",
      CODES },
    { '<feGaussianBlur stdDeviation="2"/>', 'surfaceScale="1" lighting-color="#48f"',
      '<fePointLight x="30" y="90" z="60"/>', "", CODES },
    { BLUR, 'surfaceScale="2" constant=".3"', '<feDistantLight azimuth="45" elevation="50"/>' },
  }
  for i, light in ipairs(lights) do
    for name, kind in pairs { feDiffuseLighting = "diffuse", feSpecularLighting = "specular" } do
      local attributes = light[2]:gsub("constant", kind .. "Constant")
      if kind == "specular" then
        attributes = ('%s specularExponent="%d"'):format(attributes, i % 4 * 2 + 1)
      end
      cases[name][i] = { ("%s<%s %s>%s</%s>%s"):format(light[1], name, attributes, light[3], name,
        light[4] or ""), light[5] }
    end
  end

  --- A drawing on a dark ground: colours that vary, holes, and slanted edges.
  local function drawing(case, number)
    return (HEAD:format "" .. '<rect width="120" height="100" fill="#345"/><filter id="fN" %s>%s'
      .. '</filter><linearGradient id="gN"><stop stop-color="#f80"/><stop offset="1" '
      .. 'stop-color="#06c" stop-opacity=".4"/></linearGradient><g filter="url(#fN)">'
      .. '<rect x="12" y="10" width="70" height="60" fill="url(#gN)"/>'
      .. '<circle cx="78" cy="62" r="30" fill="#2a6" fill-opacity=".8"/>'
      .. '<path d="M20 88 L60 40 L100 92 Z" fill="#c34"/></g></svg>'):format(case[2] or LIGHT,
      case[1]):gsub("([fg])N", "%1" .. number)
  end

  --- All drawings in the browser, four below each other in a column.
  local function draw_in_browser(list)
    local parts = {}
    for i, case in ipairs(list) do
      parts[i] = ('<div style="position:absolute;left:%dpx;top:%dpx">%s</div>'):format(
        (i - 1) // 4 * W, (i - 1) % 4 * H, (drawing(case, i)))
    end
    return filtered.in_browser(table.concat(parts), 5 * W, 4 * H)
  end

  for name, list in pairs(cases) do
    in_browser(("draw %s as Chromium in 20 drawings: 97 %% of pixels within 8 codes"):format(name),
      function()
        assert.equal(20, #list)
        local theirs = draw_in_browser(list)
        for i, case in ipairs(list) do
          local share = filtered.share_near(draw((drawing(case, i))), theirs, (i - 1) // 4 * W,
            (i - 1) % 4 * H)
          assert.is_true(share >= 0.97, ("drawing %d: %g"):format(i, share))
        end
      end)
  end
end)
