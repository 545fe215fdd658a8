-- feTurbulence beside the program of its specification, written again, and beside Chromium.
local filtered = require "tests.support.filtered"
local present = require "tests.support.present"

local in_browser = present.program "chromium" and it or pending
local W, H = filtered.width, filtered.height
local HEAD = ('<svg xmlns="http://www.w3.org/2000/svg" width="%d" height="%d">'):format(W, H)
local WHOLE = 'x="0" y="0" width="1" height="1"'
local CODES = WHOLE .. ' color-interpolation-filters="sRGB"'
local RECT = '<rect x="10" y="8" width="100" height="84" fill="#c84" filter="url(#f)"/>'

--- The text of a drawing on a white ground, with a filter that begins with this turbulence.
local function drawing(attributes, filter, element)
  local text = '%s<rect width="120" height="100" fill="#fff"/><filter id="f" %s>'
    .. "<feTurbulence %s/></filter>%s</svg>"
  return text:format(HEAD, filter or CODES, attributes, element or RECT)
end

-- ---------------------------------------------------------------- the program of the specification

local function tables_of(seed)
  local lattice, gradients = {}, { {}, {}, {}, {} }
  local function random()
    seed = 16807 * seed % 2147483647
    return seed
  end
  if seed <= 0 then seed = -math.fmod(seed, 2147483646) + 1 end
  for channel = 1, 4 do
    for i = 0, 255 do
      local x = (random() % 512 - 256) / 256
      local y = (random() % 512 - 256) / 256
      local length = math.sqrt(x * x + y * y)
      gradients[channel][i] = { x / length, y / length }
    end
  end
  for i = 0, 255 do lattice[i] = i end
  for i = 255, 1, -1 do
    local j = random() % 256
    lattice[i], lattice[j] = lattice[j], lattice[i]
  end
  return lattice, gradients
end

local function noise_of(lattice, gradient, x, y)
  local column, row = math.floor(x), math.floor(y)
  local sum = 0
  for dy = 0, 1 do
    for dx = 0, 1 do
      local g = gradient[lattice[(lattice[(column + dx) % 256] + row + dy) % 256]]
      local u, v = x - column - dx, y - row - dy
      local share_x, share_y = 1 - math.abs(u), 1 - math.abs(v)
      sum = sum + share_x ^ 2 * (3 - 2 * share_x) * share_y ^ 2 * (3 - 2 * share_y)
        * (g[1] * u + g[2] * v)
    end
  end
  return sum
end

--- The codes of red, green, blue and alpha at a point.
local function expected(given, x, y)
  local lattice, gradients = tables_of(given.seed)
  local codes = {}
  for channel = 1, 4 do
    local sum = 0
    for octave = 0, given.octaves - 1 do
      local scale = 2 ^ octave
      local value = noise_of(lattice, gradients[channel], x * given.fx * scale,
        y * given.fy * scale)
      sum = sum + (given.is_fractal and value or math.abs(value)) / scale
    end
    codes[channel] = 255 * math.max(0, math.min(given.is_fractal and (sum + 1) / 2 or sum, 1))
  end
  return codes
end

local function draw(text)
  local image, left_out = filtered.draw(text)
  assert.equal("", left_out)
  return image
end

describe("feTurbulence", function()
  it("has the numbers of the specification's program", function()
    for _, given in ipairs { { is_fractal = true, fx = 0.05, fy = 0.05, octaves = 1, seed = 0 },
      { is_fractal = true, fx = 0.02, fy = 0.13, octaves = 3, seed = 7 },
      { is_fractal = false, fx = 0.04, fy = 0.04, octaves = 2, seed = -3 },
      { is_fractal = false, fx = 0.11, fy = 0.03, octaves = 5, seed = 2147483646 } } do
      local codes = draw(drawing(('type="%s" baseFrequency="%g %g" numOctaves="%d" seed="%d"')
        :format(given.is_fractal and "fractalNoise" or "turbulence", given.fx, given.fy,
        given.octaves, given.seed))):bytes()
      for x = 12, 108, 8 do
        for y = 10, 90, 16 do
          local wanted = expected(given, x + 1, y + 1)
          for c = 1, 3 do -- over white
            local share = wanted[4] / 255
            local code = wanted[c] * share + 255 * (1 - share)
            local found = codes:byte(4 * (W * y + x) + c)
            assert.is_true(math.abs(code - found) <= 1, ("%g instead of %g"):format(found, code))
          end
        end
      end
    end
  end)

  it("is drawn, or is nothing, whatever the numbers are", function()
    for _, attributes in ipairs { "", 'baseFrequency="0"', 'baseFrequency="-1"', 'numOctaves="0"',
      'baseFrequency="1e9" numOctaves="1000000"', 'baseFrequency="x" seed="nothing"',
      'baseFrequency="0.05" seed="1e12"', 'baseFrequency="1e-9" numOctaves="-5"',
      'baseFrequency="1e12 1e-12" stitchTiles="stitch" type="fractalNoise" numOctaves="9"',
      'x="1000" width="0"' } do
      draw(drawing(attributes))
    end
    draw(drawing('baseFrequency="0.1" numOctaves="24"', 'x="-9e5" width="1e6" height="100"'))
    draw(drawing('baseFrequency="0.1"', 'primitiveUnits="objectBoundingBox"'))
    for _, scale in ipairs { 1e-9, 1e-13, 1e-200 } do
      draw(drawing('baseFrequency="0.1"', "", ('<g transform="translate(9 9) scale(%g)">%s</g>')
        :format(scale, RECT)))
    end
  end)

  local cases = {
    { 'type="fractalNoise" baseFrequency="0.02"', WHOLE },
    { 'type="fractalNoise" baseFrequency="0.05" numOctaves="3"', WHOLE },
    { 'type="turbulence" baseFrequency="0.03"', WHOLE },
    { 'type="turbulence" baseFrequency="0.03" numOctaves="4" seed="5"', WHOLE },
    { 'baseFrequency="0.1"', WHOLE }, { 'baseFrequency="0.02 0.1" numOctaves="2"', WHOLE },
    { 'type="fractalNoise" baseFrequency="0.02"' },
    { 'type="turbulence" baseFrequency="0.05" numOctaves="2"' },
    { 'type="fractalNoise" baseFrequency="0.04" seed="-3"' },
    { 'type="fractalNoise" baseFrequency="0.04" seed="12.7"' },
    { 'type="fractalNoise" baseFrequency="0.033" stitchTiles="stitch"' },
    { 'baseFrequency="0.027 0.041" numOctaves="3" stitchTiles="stitch"' },
    { 'type="fractalNoise" baseFrequency="0"' }, { 'baseFrequency="0.05" numOctaves="0"' },
    { 'type="fractalNoise" baseFrequency="0.2" numOctaves="2"' },
    { 'type="fractalNoise" baseFrequency="0.04" x="20" y="20" width="50" height="40"' },
    { 'type="fractalNoise" baseFrequency="0.04" numOctaves="2"', CODES,
      '<g transform="translate(5 3) scale(0.8)">' .. RECT .. "</g>" },
    { 'type="fractalNoise" baseFrequency="0.04" numOctaves="2"', CODES,
      '<g transform="scale(2)"><rect x="5" y="4" width="50" height="42" filter="url(#f)"/></g>' },
    { 'type="fractalNoise" baseFrequency="0.03" numOctaves="5"/><feColorMatrix type="saturate" '
      .. 'values="0"/><feComposite in2="SourceGraphic" operator="in"', CODES,
      '<circle cx="60" cy="50" r="40" filter="url(#f)"/>' },
    { 'baseFrequency="0.015 0.08" numOctaves="3" seed="2" result="n"/><feBlend in="n" '
      .. 'in2="SourceGraphic" mode="multiply"', WHOLE },
  }

  in_browser("is that of Chromium in 20 drawings: 98 % of pixels within 8 codes", function()
    for i, case in ipairs(cases) do
      local text = drawing(table.unpack(case, 1, 3))
      local share = filtered.share_near(draw(text), filtered.in_browser(text))
      assert.is_true(share >= 0.98, ("drawing %d: %g"):format(i, share))
    end
  end)
end)
