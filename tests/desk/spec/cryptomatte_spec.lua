-- Cryptomatte in OpenEXR files. The decoder here is written from the specification (Cryptomatte
-- Specification 1.2.0, Psyop) alone; areas are computed exactly, from upright rectangles.
local exr = require "tests.support.exr"
local present = require "tests.support.present"
local prng = require "tests.support.prng"
local workbench = require "tests.support.workbench"

local it_reads = present.program "oiiotool" and it or pending

local SIDE = 16

local HEAD = [[
local celspan = require "celspan"
local function box(x, y, w, h, texture) return celspan.rect { x, y, w, h, texture = texture } end
local function still(width, height, rostrum)
  return celspan.film { size = { width, height }, frame = function() return rostrum end }
end
]]

---------------------------------------------------------------- the decoder

--- MurmurHash3_x86_32 with seed 0, then the exponent that no float may have.
local function id_of(name)
  local function rotate(word, bits) return (word << bits | word >> 32 - bits) & 0xffffffff end
  local function mix(word)
    return rotate(word * 0xcc9e2d51 & 0xffffffff, 15) * 0x1b873593 & 0xffffffff
  end
  local hash, whole = 0, #name // 4 * 4
  for i = 1, whole, 4 do
    hash = rotate(hash ~ mix(("<I4"):unpack(name, i)), 13) * 5 + 0xe6546b64 & 0xffffffff
  end
  local tail = 0
  for i = #name, whole + 1, -1 do tail = tail << 8 | name:byte(i) end
  if #name > whole then hash = hash ~ mix(tail) end
  hash = hash ~ #name
  hash = (hash ~ hash >> 16) * 0x85ebca6b & 0xffffffff
  hash = (hash ~ hash >> 13) * 0xc2b2ae35 & 0xffffffff
  hash = hash ~ hash >> 16
  local exponent = hash >> 23 & 255
  return (exponent == 0 or exponent == 255) and hash ~ 1 << 23 or hash
end

--- The texts of the mattes of a layer, and their ids by name.
local function manifest_of(file, layer)
  for name, value in pairs(file.attributes) do
    local key = name:match "^cryptomatte/(%x%x%x%x%x%x%x)/name$"
    if key and value == layer then
      local function text(field) return file.attributes["cryptomatte/" .. key .. "/" .. field] end
      assert.equal("MurmurHash3_32", text "hash")
      assert.equal("uint32_to_float32", text "conversion")
      local ids = {}
      local json = text "manifest"
      assert.truthy(json:find "^{.*}$")
      for entry, hex in json:gmatch '"([^"]*)":"(%x%x%x%x%x%x%x%x)"' do ids[entry] = hex end
      return json, ids
    end
  end
end

--- The weights of a pixel by id, from the first rank to the last.
local function ranks_of(file, layer, x, y)
  local out = {}
  for rank = 0, 5 do
    local channel = ("%s%02d."):format(layer, rank // 2)
    local letters = rank % 2 == 0 and { "R", "G" } or { "B", "A" }
    local id = file.bits(channel .. letters[1], x, y)
    local weight = file.value(channel .. letters[2], x, y)
    if id ~= 0 or weight ~= 0 then out[#out + 1] = { id = id, weight = weight } end
  end
  return out
end

---------------------------------------------------------------- exact areas

--- The exact weights by name of pixel x, y. stack: rectangles from the back, { x, y, w, h, alpha =,
--- name =, clip = rectangle }: between two neighbouring edges nothing changes.
local function weights_of(stack, x, y)
  local function cuts(low, first, size)
    local list = { low, low + 1 }
    for _, piece in ipairs(stack) do
      for _, box in ipairs { piece, piece.clip } do
        for _, at in ipairs { box[first], box[first] + box[size] } do
          if at > low and at < low + 1 then list[#list + 1] = at end
        end
      end
    end
    table.sort(list)
    return list
  end
  local function is_in(box, px, py)
    return px >= box[1] and px < box[1] + box[3] and py >= box[2] and py < box[2] + box[4]
  end
  local weights, columns, rows = {}, cuts(x, 1, 3), cuts(y, 2, 4)
  for i = 1, #columns - 1 do
    for k = 1, #rows - 1 do
      local px, py = (columns[i] + columns[i + 1]) / 2, (rows[k] + rows[k + 1]) / 2
      local left = (columns[i + 1] - columns[i]) * (rows[k + 1] - rows[k])
      for n = #stack, 1, -1 do
        local piece = stack[n]
        if is_in(piece, px, py) and (not piece.clip or is_in(piece.clip, px, py)) then
          if piece.name then
            weights[piece.name] = (weights[piece.name] or 0) + left * piece.alpha
          end
          left = left * (1 - piece.alpha)
        end
      end
    end
  end
  return weights
end

---------------------------------------------------------------- scenes by chance

local function chance_box(random)
  return { random:between(-3, 12), random:between(-3, 12), random:between(0.2, 9),
           random:between(0.2, 9) }
end

local function code_of(box, alpha)
  return ("box(%.17g, %.17g, %.17g, %.17g, celspan.rgb(0.7, 0.5, 0.2, %.17g))")
    :format(box[1], box[2], box[3], box[4], alpha)
end

--- Cels of rectangles, some with light through them: the code, and the stack by the names of cels.
local function chance_cels(random)
  local names, stack, cels = { "a", "b", "c", "d", "e e", "\u{e4}" }, {}, {}
  for i = 1, random:whole(1, 9) do
    local name = not random:once(4) and random:pick(names)
    local opacity = random:once(3) and random:between(0.1, 1) or 1
    local box, alpha = chance_box(random), random:once(2) and 1 or random:between(0, 1)
    stack[#stack + 1] = { box[1], box[2], box[3], box[4], alpha = alpha * opacity,
                          name = name or "cel_" .. i }
    local back = random:once(3) and 'back = "#345", ' or ""
    cels[i] = ("celspan.cel { %sopacity = %.17g, %s }%s"):format(back, opacity, code_of(box, alpha),
      name and (":named %q"):format(name) or "")
  end
  return table.concat(cels, ",\n  "), stack
end

--- A tree of objects: the code; its rectangles are added to the stack.
local function chance_tree(random, depth, name, clip, stack)
  local own = random:once(3) and random:pick { "a", "b", "c", "d" }
  local ending = own and (":named %q"):format(own) or ""
  name = own or name
  if depth == 0 or random:once(3) then
    local box, alpha = chance_box(random), random:once(2) and 1 or random:between(0, 1)
    stack[#stack + 1] = { box[1], box[2], box[3], box[4], alpha = alpha, name = name, clip = clip }
    return code_of(box, alpha) .. ending
  end
  if not clip and random:once(4) then
    local frame = chance_box(random)
    local code = chance_tree(random, depth - 1, name, frame, stack)
    return ("celspan.clip(%s, %s)%s"):format(code, code_of(frame, 1), ending)
  end
  local parts = {}
  for i = 1, random:whole(1, 4) do
    parts[i] = chance_tree(random, depth - 1, name, clip, stack)
  end
  return ("celspan.union { %s }%s"):format(table.concat(parts, ", "), ending)
end

local function chance_names(random)
  local stack, cels = {}, {}
  for i = 1, random:whole(1, 4) do
    local name = random:once(2) and random:pick { "a", "b", "z" }
    local parts = {}
    for k = 1, random:whole(1, 3) do
      parts[k] = chance_tree(random, 3, name or nil, nil, stack)
    end
    cels[i] = ("celspan.cel { %s }%s"):format(table.concat(parts, ", "),
      name and (":named %q"):format(name) or "")
  end
  return table.concat(cels, ",\n  "), stack
end

---------------------------------------------------------------- the tests

describe("--cryptomatte", function()
  local bench

  before_each(function() bench = workbench.new() end)
  after_each(function() bench:remove() end)

  local function render(script, arguments)
    bench:write("film.lua", script)
    local code, _, err = bench:celspan_inside("render film.lua --progress none %s", arguments)
    assert.equal(0, code, err)
    return err
  end
  --- The file, without compression.
  local function decode(name)
    local code, out, err = bench:inside("oiiotool " .. name .. " --compression none -o flat.exr")
    assert.equal(0, code, out .. err)
    return exr.decode(bench:read "flat.exr")
  end
  local function check_pixel(file, layer, x, y, weights, ids, where)
    local found, before, sum = ranks_of(file, layer, x, y), math.huge, 0
    for _, rank in ipairs(found) do
      assert.is_true(rank.weight > 0 and rank.weight <= before, where)
      before = rank.weight
      local name = ids[rank.id]
      assert.truthy(name, where)
      assert.is_true(math.abs(rank.weight - (weights[name] or 0)) < 1e-4, ("%s: %s is %g, not %g")
        :format(where, name, rank.weight, weights[name] or 0))
      sum = sum + rank.weight
    end
    local seen = 0
    for name, weight in pairs(weights) do
      seen = seen + (weight > 1e-4 and 1 or 0)
      local is_there = false
      for _, rank in ipairs(found) do is_there = is_there or ids[rank.id] == name end
      assert.is_true(is_there or weight < 1e-4 or (#found == 6 and weight <= before + 1e-4), where)
    end
    assert.is_true(sum <= 1 + 1e-5 and #found >= math.min(seen, 6), where)
  end
  local function check(by, layer, chance, seeds)
    for seed = 1, seeds do
      local code, stack = chance(prng.new(seed))
      render(("%sreturn still(%d, %d, celspan.rostrum {\n  %s\n})"):format(HEAD, SIDE, SIDE, code),
        "--cryptomatte " .. by .. " -o x.exr")
      local file, ids = decode "x.exr", {}
      local _, hexes = manifest_of(file, layer)
      for name, hex in pairs(hexes) do
        assert.equal(("%08x"):format(id_of(name)), hex)
        ids[id_of(name)] = name
      end
      for y = 0, SIDE - 1 do
        for x = 0, SIDE - 1 do
          check_pixel(file, layer, x, y, weights_of(stack, x, y), ids,
            ("seed %d, pixel %d, %d"):format(seed, x, y))
        end
      end
    end
  end

  it("has a decoder that knows the numbers of MurmurHash3", function()
    assert.equal(0x248bfa47, id_of "hello")
    assert.equal(0x2e4ff723, id_of "The quick brown fox jumps over the lazy dog")
    assert.equal(1 << 23, id_of "")
  end)

  it_reads("gives cels the exact area that is seen of them, times alpha", function()
    check("cels", "CryptoCel", chance_cels, 8)
  end)

  it_reads("gives the same to the innermost names of objects", function()
    check("names", "CryptoName", chance_names, 10)
  end)

  it_reads("is in floats, with the exact edges of a curve, whatever the depth", function()
    local disc = HEAD .. [[return still(64, 64, celspan.rostrum { back = "#fff",
      celspan.cel { celspan.circle { centre = { 32.3, 31.6 }, radius = 20.2 } }:named "disc",
      celspan.cel { box(0, 0, 64, 33.25, "#f00") }:named "shade" })]]
    render(disc, "--depth half --layers cels --cryptomatte cels -o x.exr")
    local file, area = decode "x.exr", 0
    for _, channel in ipairs(exr.decode(bench:read "x.exr").channels) do
      assert.equal(channel.name:find "^Crypto" and 2 or 1, channel.kind)
    end
    for y = 0, 63 do
      for x = 0, 63 do
        for _, rank in ipairs(ranks_of(file, "CryptoCel", x, y)) do
          if rank.id == id_of "disc" then area = area + rank.weight end
        end
      end
    end
    local r, h = 20.2, 33.25 - 31.6
    local below = math.pi * r * r / 2 - h * math.sqrt(r * r - h * h) - r * r * math.asin(h / r)
    assert.is_true(math.abs(area - below) < 0.01, area .. " " .. below)
    assert.equal("backlight,disc,shade", file.attributes["celspan:layers"])
  end)

  it_reads("adds exposures by their weights", function()
    render(HEAD .. [[
      local function at(x) return celspan.rostrum {
        celspan.cel { box(x, 0, 4, 8, "#fff") }:named "a" } end
      return still(8, 8, { { at(0), 0.25 }, { at(2), 0.75 }, { at(4), 0 } })]],
      "--cryptomatte cels -o x.exr")
    local file = decode "x.exr"
    for x, weight in pairs { [0] = 0.25, [2] = 1, [4] = 0.75 } do
      assert.is_true(math.abs(ranks_of(file, "CryptoCel", x, 4)[1].weight - weight) < 1e-6)
    end
    assert.equal(0, #ranks_of(file, "CryptoCel", 6, 4))
  end)

  it_reads("keeps the six names that are seen most", function()
    local cels = {}
    for i = 1, 9 do
      cels[i] = ("celspan.cel { box(%.2f, 0, %.2f, 1, '#fff') }:named 'c%d'")
        :format((i - 1) * i / 2 / 45, i / 45, i)
    end
    render(HEAD .. "return still(1, 1, celspan.rostrum { " .. table.concat(cels, ", ") .. " })",
      "--cryptomatte cels -o x.exr")
    local found = ranks_of(decode "x.exr", "CryptoCel", 0, 0)
    for rank = 1, 6 do assert.equal(id_of("c" .. 10 - rank), found[rank].id) end
  end)

  it_reads("has names as they are in the manifest, and none of layers in their way", function()
    local name = [[a "b" \ c/d.e, ]] .. "\u{e4}\u{20ac}"
    render(HEAD .. ([[return still(8, 8, celspan.rostrum {
      celspan.cel { box(0, 0, 8, 8, "#fff") }:named(%q),
      celspan.cel { box(0, 0, 8, 4, "#fff") }:named "CryptoCel00" })]]):format(name),
      "--layers cels --cryptomatte cels -o x.exr")
    local file = decode "x.exr"
    local json = manifest_of(file, "CryptoCel")
    assert.equal(([[{"a \"b\" \\ c/d.e, %s":"%08x","CryptoCel00":"%08x"}]]):format(
      "\u{e4}\u{20ac}", id_of(name), id_of "CryptoCel00"), json)
    assert.truthy(file.attributes["celspan:layers"]:find ",CryptoCel00_2$")
    assert.equal(id_of(name), ranks_of(file, "CryptoCel", 2, 6)[1].id)
  end)

  it_reads("has numbers that are no infinities and not too small for a float", function()
    render(HEAD .. [[return still(8, 8, celspan.rostrum {
      celspan.cel { box(0, 0, 8, 4, "#fff") }:named "cel272",
      celspan.cel { box(0, 4, 8, 4, "#fff") }:named "cel772" })]], "--cryptomatte cels -o x.exr")
    local file = decode "x.exr"
    local _, ids = manifest_of(file, "CryptoCel")
    assert.same({ cel272 = "00c5dd48", cel772 = "ff2ed469" }, ids)
    assert.equal(0x00c5dd48, ranks_of(file, "CryptoCel", 2, 2)[1].id)
    assert.equal(0xff2ed469, ranks_of(file, "CryptoCel", 2, 6)[1].id)
  end)

  it_reads("leaves out what has no name, which still hides", function()
    render(HEAD .. [[return still(8, 8, celspan.rostrum {
      celspan.cel { celspan.union { box(0, 0, 8, 8, "#fff"):named "far", box(0, 0, 8, 4, "#000") },
        box(0, 6, 8, 2, "#fff8") } })]], "--cryptomatte names -o x.exr")
    local file = decode "x.exr"
    local _, ids = manifest_of(file, "CryptoName")
    assert.same({ far = ("%08x"):format(id_of "far") }, ids)
    assert.equal(0, #ranks_of(file, "CryptoName", 2, 2))
    assert.equal(1, ranks_of(file, "CryptoName", 2, 5)[1].weight)
    assert.is_true(math.abs(ranks_of(file, "CryptoName", 2, 7)[1].weight - 119 / 255) < 1e-5)
    render(HEAD .. [[return still(8, 8, celspan.rostrum {
      celspan.cel { box(0, 0, 8, 8, "#fff") } })]], "--cryptomatte names -o y.exr")
    file = decode "y.exr"
    assert.equal("{}", manifest_of(file, "CryptoName"))
    assert.equal(0, #ranks_of(file, "CryptoName", 2, 2))
  end)

  it_reads("does not depend on workers, and keeps what --resume finds by all names", function()
    local function scene(name)
      return HEAD .. ([[return celspan.film { size = { 300, 200 }, frames = 2, frame = function(f)
        local cels = {}
        for i = 1, 12 do
          cels[i] = celspan.cel { celspan.circle { centre = { 20 * i + f.number, 90 },
            radius = 30 + i, texture = "#fff8" }:named(i == 5 and "%s" or "x" .. i) }
        end
        return celspan.rostrum(cels) end }]]):format(name)
    end
    for workers = 1, 3 do
      render(scene "five", ("--frames 1 --cryptomatte names --layers cels --workers %d -o w%d.exr")
        :format(workers, workers))
    end
    assert.equal(bench:read "w1.exr", bench:read "w2.exr")
    assert.equal(bench:read "w1.exr", bench:read "w3.exr")
    local function ways(name, more)
      bench:write("film.lua", scene(name))
      local code, _, err = bench:celspan_inside(
        "render film.lua --progress lines --resume -o 'r.#.exr' %s", more)
      assert.equal(0, code, err)
      return err:match "(%d) kept" or "0"
    end
    assert.equal("0", ways("five", "--cryptomatte names"))
    assert.equal("2", ways("five", "--cryptomatte names"))
    assert.equal("0", ways("six", "--cryptomatte names"))
    assert.equal("0", ways("six", "--cryptomatte cels"))
    assert.equal("2", ways("six", "--cryptomatte cels"))
  end)

  it("is refused where it cannot be written", function()
    bench:write("film.lua", HEAD .. [[local cels = {}
      for i = 1, 256 do cels[i] = celspan.cel { box(i, 0, 1, 8, "#fff"):named("n" .. i) } end
      return still(256, 8, celspan.rostrum(cels))]])
    for arguments, words in pairs {
      ["--cryptomatte cels -o x.png"] =
        "no --cryptomatte: leave it out; it is only for files with layers (exr",
      ["--cryptomatte cels -o x.mp4"] = "mp4 takes no --cryptomatte",
      ["--cryptomatte objects -o x.exr"] = "cels or names",
      ["--cryptomatte cels --hash -o x.exr"] = "exr with layers takes no --hash",
      ["--cryptomatte cels --colour srgb -o x.exr"] =
        "exr with layers takes --colour linear, and not srgb",
      ["--cryptomatte names -o x.exr"] = "more than 255 pieces with different names",
    } do
      local code, _, err = bench:celspan_inside("render film.lua --progress none %s", arguments)
      assert.not_equal(0, code)
      assert.truthy(err:find(words, 1, true), err)
      assert.is_nil(bench:read "x.exr")
    end
  end)
end)
