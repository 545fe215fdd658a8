-- Layered paintings as written by programs of every kind: large documents and archives, names in
-- every script, the names of blend modes, additional data of Photoshop, Krita and others; and the
-- places where such a file may be damaged. tests/kit/spec/layers_spec.lua compares the formats with
-- each other. One list of cases, as long as the list of those programs.
local celspan = require "celspan"
local layers = require "celspan.layers"
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local stored = require "tests.support.stored"
local workbench = require "tests.support.workbench"

local bench, count = workbench.new(), 0

local function write(bytes)
  count = count + 1
  return bench:write("painting-" .. count, bytes)
end

local function read(bytes) return assert(layers.read(write(bytes))) end

local function refused(bytes, pattern)
  local tree, message = layers.read(write(bytes))
  assert.is_nil(tree)
  assert.matches(pattern, message)
end

local function seen(tree)
  return celspan.pixels(celspan.rostrum(tree:cels()), { size = { tree.width, tree.height } })
end

local function fails_when_seen(bytes, pattern)
  local image, message = seen(read(bytes))
  assert.is_nil(image)
  assert.matches(pattern, message)
end

--- "layer: what" for each part that is not shown.
local function told(tree)
  local list = {}
  for i, one in ipairs(tree.skipped) do list[i] = one.layer .. ": " .. one.what end
  return list
end

local function speckle(x, y)
  return (x * 7 + y * 13) % 256, x * 3 % 256, 255 - y, (x + y) % 3 * 127
end

local function layer_of(fields)
  local layer = { name = "ink", x = 1, y = 2, w = 9, h = 7, pixel = speckle }
  for name, value in pairs(fields or {}) do layer[name] = value end
  return layer
end

local function psd(fields, document)
  local given = { w = 12, h = 10, layers = { layer_of(fields) } }
  for name, value in pairs(document or {}) do given[name] = value end
  return paintings.psd(given)
end

local it_reads_archives = present.type() and it or pending

teardown(function() bench:remove() end)

-- ---------------------------------------------------------------- glows

describe("a painted glow", function()
  --- Light that falls from the left to the right, in a few of the 256 steps of alpha.
  local glow = psd({ blend = "lddg", x = 0, y = 0, w = 240, h = 40,
    pixel = function(x) return 255, 200, 120, 12 - x // 20 end }, { w = 240, h = 40 })

  --- The greatest difference of neighbours in the middle row, in codes of 8 bits.
  local function ring(options)
    local tree = assert(layers.read(write(glow), options))
    local ground = celspan.cel { celspan.rect { 0, 0, 240, 40, texture = "#101018" } }
    local image = assert(celspan.pixels(celspan.rostrum { ground, tree:cels()[1] },
      { size = { 240, 40 } }))
    local row, most = image:bytes({ depth = 16 }):sub(20 * 240 * 8 + 1, 21 * 240 * 8), 0
    for x = 1, 238 do
      local before, after = ("<I2"):unpack(row, 8 * x - 7), ("<I2"):unpack(row, 8 * x + 1)
      most = math.max(most, math.abs(after - before) / 257)
    end
    return most
  end

  it("has rings in the dark, and none where it is read smooth", function()
    local rough, smooth = ring(), ring { smooth = true }
    assert.is_true(rough > 3 and smooth < 0.6, rough .. " " .. smooth)
  end)

  it("is read smooth by a field alone that is known", function()
    assert.has_error(function() layers.read("x.psd", { smoth = true }) end,
      "layers: read: unknown field 'smoth'; did you mean 'smooth'?")
  end)
end)

-- ---------------------------------------------------------------- Photoshop

describe("a Photoshop document", function()
  it("may be a large one, in every packing and depth", function()
    for _, packing in ipairs { "raw", "packbits", "zip", "predicted" } do
      for _, depth in ipairs { 8, 16 } do
        local small = psd({ packing = packing }, { depth = depth })
        local large = psd({ packing = packing }, { depth = depth, large = true })
        assert.are_not.equal(small, large)
        assert.is_true(assert(seen(read(large))):bytes() == assert(seen(read(small))):bytes(),
          packing)
      end
    end
  end)

  it("may be a large one without layers", function()
    local packed = "\0\1" .. (">I4"):rep(6):gsub(">I4", function() return "\0\0\0\3" end)
      .. "\1\1\2\1\3\4\1\5\6\1\7\8\1\9\10\1\11\12"
    local tree = read(paintings.psd { w = 2, h = 2, large = true, merged = packed })
    assert.are.equal("\4\8\12\255", assert(seen(tree)):bytes():sub(13, 16))
  end)

  it("has names in every script, truncated if they are long", function()
    for _, name in ipairs { "Ebene", "\xC3\xA4\xC3\x9F", "\xE6\xBC\xA2\xE5\xAD\x97",
      "a\xF0\x9F\x8E\xA8b" } do
      assert.are.equal(name, read(psd { name = name })[1].name)
    end
    local long =
      read(psd { name = "x",
        tags = paintings.tag("luni", string.pack(">I4", 300) .. ("\0y"):rep(300)) })[1].name
    assert.matches("^y+$", long)
    assert.is_true(#long > 200 and #long < 300)
  end)

  it("has names whose characters are repaired or left as they were", function()
    local function named(units)
      return read(psd { name = "x",
        tags = paintings.tag("luni", string.pack(">I4", #units // 2) .. units) })[1].name
    end
    assert.are.equal("a?b", named "\0a\0\7\0b")
    assert.are.equal("a?b", named "\0a\0\x85\0b")
    assert.matches("^%?+$", named "\xD8\x00")
    assert.matches("^%?+$", named "\xDC\x00")
    local false_size =
      read(psd { name = "x", tags = paintings.tag("luni", string.pack(">I4", 99) .. "\0a") })
    assert.are.equal("x", false_size[1].name)
  end)

  it("has the names of all blend modes, and keeps unknown ones", function()
    local words = { norm = "normal", ["mul "] = "multiply", lddg = "linear-dodge", scrn = "screen",
      over = "overlay", ["lum "] = "luminosity", sLit = "soft-light-photoshop",
      fdiv = "divide", ["zz 9"] = "zz9", ["\1\200x\127"] = "x" }
    for key, word in pairs(words) do assert.are.equal(word, read(psd { blend = key })[1].blend) end
    local group = paintings.psd { w = 4, h = 4,
      layers = { { name = "g", blend = "scrn", layers = { layer_of() } } } }
    assert.are.equal("screen", read(group)[1].blend)
  end)

  it("has groups that two kinds of blocks mark, long or short", function()
    local function of(tag, data) return { name = "g", tags = paintings.tag(tag, data) } end
    for _, tag in ipairs { "lsct", "lsdk" } do
      for _, open in ipairs { 1, 2 } do
        local tree = read(paintings.psd { w = 12, h = 10,
          layers = { of(tag, string.pack(">I4", 3)), layer_of(),
          of(tag, string.pack(">I4", open)) } })
        assert.are.equal("ink", tree[1].children[1].name)
        assert.are.equal("normal", tree[1].blend)
      end
    end
    local plain = read(paintings.psd { w = 12, h = 10,
      layers = { of("lsct", string.pack(">I4", 0)), of("lsct", "\0\0") } })
    assert.are.equal(2, #plain)
    assert.is_nil(plain[1].children)
  end)

  it("multiplies the opacity of a layer by that of its fill", function()
    assert.are.equal(102 * 127,
      read(psd { opacity = 0.4, tags = paintings.tag("iOpa", "\127\0\0\0") })[1].opacity * 255
      * 255)
    assert.are.equal(1, read(psd { tags = paintings.tag("iOpa", "") })[1].opacity)
  end)

  it("has blocks that are padded in every way, and blocks that mean nothing", function()
    for padding = 0, 3 do
      local tags = paintings.tag("zzzz", "\1\2") .. ("\0"):rep(padding)
        .. paintings.tag("iOpa", "\0\0") .. ("\0"):rep(3)
      assert.are.equal(0, read(psd { tags = tags })[1].opacity, padding)
    end
    local after = read(psd { tags = ("\0"):rep(4) .. paintings.tag("iOpa", "\0\0") })
    assert.are.equal(1, after[1].opacity) -- what follows such a hole is no block
    local foreign = read(psd { tags = "8B64" .. paintings.tag("iOpa", "\0\0"):sub(5) })
    assert.are.equal(0, foreign[1].opacity)
  end)

  it("reports the parts of a layer that are not shown", function()
    local tag = paintings.tag
    local cases = {
      { { tags = tag("curv", "\0\0") }, "an adjustment: it changes nothing here" },
      { { tags = tag("lfx2", "\0\0") }, "layer effects: they are not drawn" },
      { { tags = tag("vmsk", "\0\0") }, "a vector mask: it is shown whole" },
      { { ranges = string.pack(">I4I4", 0xFFFF, 0x10FFFF) },
        "blended by lightness ranges: it is shown whole" },
    }
    for _, case in ipairs(cases) do
      assert.are.same({ "ink: " .. case[2] }, told(read(psd(case[1]))))
    end
    local fill = paintings.psd { w = 4, h = 4,
      layers = { { name = "ink", tags = tag("SoCo", "\0\0") } } }
    assert.are.same({ "ink: a fill without pixels: it is empty" }, told(read(fill)))
    assert.are.same({}, told(read(psd { tags = tag("SoCo", "\0\0") .. tag("vsms", "\0\0") })))
    assert.are.same({}, told(read(psd { ranges = string.pack(">I4I4", 0xFFFF, 0xFFFF) .. "\0" })))
  end)

  local function mask(fields)
    local given = { x = 0, y = 0, w = 12, h = 10, value = function(x)
      return x < 6 and 255 or 0
    end }
    for name, value in pairs(fields) do given[name] = value end
    return given
  end

  it("can have masks that are off, inverted, of less density, or opaque outside", function()
    local opaque = function() return 10, 20, 30, 255 end
    local function alpha(fields, x)
      local image =
        assert(
          seen(read(psd { x = 0, y = 0, w = 12, h = 10, pixel = opaque, mask = mask(fields) })))
      return math.floor(255 * select(4, image:get(x, 5)) + 0.5)
    end
    assert.are.same({ 255, 0 }, { alpha({}, 2), alpha({}, 9) })
    assert.are.same({ 255, 255 }, { alpha({ flags = 2 }, 2), alpha({ flags = 2 }, 9) })
    assert.are.same({ 0, 255 }, { alpha({ flags = 4 }, 2), alpha({ flags = 4 }, 9) })
    local half = { flags = 16, more = "\1\127" }
    assert.are.same({ 255, 128 }, { alpha(half, 2), alpha(half, 9) })
    local small = { w = 3, beyond = 255, value = function() return 0 end }
    assert.are.same({ 0, 255 }, { alpha(small, 2), alpha(small, 9) })
    assert.are.same({ 255, 255 }, { alpha({ w = 0 }, 2), alpha({ w = 0 }, 9) })
    local first = { flags = 0, more = ("\0"):rep(18) } -- with the mask before that of a path
    assert.are.same({ 255, 0 }, { alpha(first, 2), alpha(first, 9) })
  end)

  it("reports masks that are feathered, or paths of less density", function()
    local sentence =
      "ink: a mask with feather, or a vector mask of less density: it is as it is stored"
    local zero, one = ("\0"):rep(8), "\63\240" .. ("\0"):rep(6)
    for parameters, is_told in pairs { ["\2" .. one] = true, ["\2" .. zero] = false,
      ["\4\9"] = true, ["\4\255"] = false,
      ["\8" .. one] = true, ["\15\255" .. zero .. "\255" .. zero] = false } do
      local tree = read(psd { mask = mask { flags = 16, more = parameters } })
      assert.are.same(is_told and { sentence } or {}, told(tree))
    end
  end)

  it("is refused wherever it is cut off before its pixels", function()
    local layer = { packing = "packbits",
      mask = mask { w = 2, h = 2, flags = 16, more = "\15\255" .. ("\0"):rep(17) },
      ranges = string.pack(">I4", 0xFFFF), w = 2, h = 2 }
    local merged = "\0\1" .. ("\0\3"):rep(6) .. "\1\1\2\1\3\4\1\5\6\1\7\8\1\9\10\1\11\12"
    for _, document in ipairs { { profile = "icc" }, { depth = 16, large = true },
      { w = 2, h = 2, layers = {}, merged = merged } } do
      local whole = psd(layer, document)
      for size = 4, document.merged and #whole - 1 or whole:find("\0*$") - 1 do
        local path = bench:write("cut.psd", whole:sub(1, size))
        local tree, message = layers.read(path)
        if tree then tree, message = seen(tree) end
        assert.is_nil(tree, size)
        assert.matches("cut%.psd: %l", message)
      end
    end
  end)

  it("shows its merged picture if a section has no layers", function()
    local plain = paintings.psd { w = 1, h = 1, merged = "\0\0\7\8\9" }
    for _, section in ipairs { string.pack(">I4I2I4", 2, 0, 0), string.pack(">I4I2", 2, 0),
      string.pack(">I4I4", 0, 0),
      string.pack(">I4I4", 0, 0) .. paintings.tag("zzzz", "abcd"),
      string.pack(">I4I4", 0, 0) .. paintings.tag("Layr", "\0\0") } do
      local tree = read(plain:sub(1, 34) .. string.pack(">s4", section) .. plain:sub(39))
      assert.are.equal("Background", tree[1].name)
      assert.are.equal("\7\8\9\255", assert(seen(tree)):bytes():sub(1, 4))
    end
  end)

  it("takes no channel twice and none that it does not know, and one that is missing as the "
    .. "greatest value", function()
    local flat = { x = 0, y = 0, w = 12, h = 10, pixel = function() return 41, 12, 99, 200 end }
    local function renumbered(from, to)
      local size = 2 + 12 * 10
      return (psd(flat):gsub(string.pack(">I2I4", from, size), string.pack(">I2I4", to, size), 1))
    end
    local function codes(bytes) return { assert(seen(read(bytes))):bytes():byte(-4, -1) } end
    assert.are.same({ 41, 12, 99, 200 }, codes(psd(flat)))
    for _, to in ipairs { 3, 0, 1, 0xFFFD } do
      assert.are.same({ 41, 12, 255, 200 }, codes(renumbered(2, to)), to)
    end
    flat.alpha = "\0"
    assert.are.same({ 41, 12, 99, 255 }, codes(psd(flat)))
    flat.alpha = nil
    assert.are.same({ 0, 0, 0, 0 }, codes(renumbered(0, 3))) -- without red there is nothing
  end)

  it("may have unused bytes in packed rows, and masks outside the layer", function()
    local row = "\128\1\1\2\128\248\9"
    local image =
      assert(
        seen(read(psd { x = 0, y = 0, h = 1, w = 11,
          alpha = "\0\1" .. string.pack(">I2", #row) .. row })))
    local function alpha(x) return math.floor(255 * select(4, image:get(x, 0)) + 0.5) end
    assert.are.same({ 1, 2, 9, 9, 0 }, { alpha(0), alpha(1), alpha(2), alpha(10), alpha(11) })
    for _, beyond in ipairs { 0, 255 } do
      local beside = mask { y = -20, h = 3, beyond = beyond, value = function()
        return 255 - beyond
      end }
      image = assert(seen(read(psd { x = 0, y = 0, w = 12, h = 10, pixel = function()
        return 1, 2, 3, 255
      end, mask = beside })))
      assert.are.equal(beyond / 255, select(4, image:get(3, 3)))
    end
  end)

  it("has short names with a question mark for each invalid character", function()
    local function named(name)
      local bytes = psd({ name = ("x"):rep(#name) }):gsub("8BIMluni", "8BIMlunx", 1)
      return read((bytes:gsub(string.char(#name) .. ("x"):rep(#name), function()
        return string.char(#name) .. name
      end, 1)))[1].name
    end
    local names = { ["\xC3\xA4b"] = "\xC3\xA4b", ["a\xFFb"] = "a?b", ["ab\xC3"] = "ab?",
      ["\xE2\x28b"] = "?(b", ["\xC0\x80b"] = "??b",
      ["\xED\xA0\x80"] = "???", ["\xF4\x90\x80\x80"] = "????", ["\xE0\x80\x80"] = "???",
      ["\xC2\x85b"] = "?b",
      ["\xC2\xA9b"] = "\xC2\xA9b", ["ab\127"] = "ab?", ["ab\0c"] = "ab" }
    for name, shown in pairs(names) do assert.are.equal(shown, named(name)) end
  end)

  it("shows groups through their masks", function()
    local function group(fields, blend)
      return read(paintings.psd { w = 12, h = 10, layers = {
        { name = "g", blend = blend, mask = mask(fields), layers = { layer_of {
          x = 0, y = 0, w = 12, h = 10, pixel = function() return 255, 0, 0, 255 end } } } } })
    end
    local function alphas(tree, object)
      local image = assert(celspan.pixels(celspan.rostrum { celspan.cel { object or tree.object } },
        { size = { 12, 10 }, film = { 12, 10 } }))
      local list = {}
      for _, place in ipairs { { 2, 5 }, { 6, 5 }, { 11, 5 }, { 6, 0 } } do
        list[#list + 1] = math.floor(select(4, image:get(place[1], place[2])) * 255 + 0.5)
      end
      return list
    end
    local part = { x = 4, y = 2, w = 4, h = 6, value = function() return 64 end }
    local tree = group(part)
    assert.are.same({}, told(tree))
    assert.are.same({ 0, 64, 0, 0 }, alphas(tree))
    assert.are.same({ 0, 64, 0, 0 }, alphas(tree, tree:find "g".object))
    part.beyond = 255
    assert.are.same({ 255, 64, 255, 255 }, alphas(group(part)))
    part.beyond, part.off = 0, true
    assert.are.same({ 255, 255, 255, 255 }, alphas(group(part)))
    part.off = nil
    tree = group(part)
    assert.are.equal(1, #tree:cels())
    local white = celspan.rect { 0, 0, 12, 10, texture = "#fff" }
    local changed = tree:with { ["g/ink"] = function() return white end }
    assert.are.same({ 0, 64, 0, 0 }, alphas(changed))
    assert.are.same({ 255, 255, 255, 255 }, alphas(tree:with { g = function() return white end }))
  end)

  it("reports a mask of a group that passes modes through", function()
    local painting = paintings.psd { w = 12, h = 10, layers = { { name = "g",
      mask = mask {}, layers = { layer_of { blend = "mul " } } } } }
    assert.are.same({ "g: a group that passes modes through, with a mask: it isolates them" },
      told(read(painting)))
  end)

  it("is refused if it contradicts itself", function()
    refused(psd({}, { version = 3 }), "an unknown version")
    refused(psd({}, { channels = 2 }), "the number of channels is invalid")
    refused(psd({}, { channels = 57 }), "the number of channels is invalid")
    refused(psd({}, { w = 0 }), "/painting%-%d+: the document has a size of 0 x 10 pixels$")
    local function masked(fields)
      fields.value = function() return 0 end
      local bytes = psd { mask = { x = 0, y = 0, w = 1, h = 1, value = fields.value } }
      return (bytes:gsub(string.pack(">i4i4i4i4", 0, 0, 1, 1),
        string.pack(">i4i4i4i4", fields[2], fields[1], fields[4], fields[3]), 1))
    end
    refused(masked { 0, 0, 2147483647, 2147483647 }, "a mask has 2147483647 x 2147483647 pixels")
    refused(masked { 2147483000, 0, 2147483001, 1 }, "a mask lies at 2147483000, 0")
    refused(psd({}, { mode = 11 }), "in an unknown kind of colour")
    refused((psd { tags = "" }):gsub("8BIMnorm", "8BIXnorm", 1), "the record of a layer is damaged")
    refused(psd { tags = "8BIMzzzz" .. string.pack(">I4", 0x7FFFFFFF) }, "a block of a layer")
    local counted = psd {}
    local at = counted:find(string.pack(">i2", -1) .. string.pack(">i4i4i4i4I2", 2, 1, 9, 10, 4), 1,
      true)
    refused(counted:sub(1, at - 1) .. string.pack(">i2", 30000) .. counted:sub(at + 2),
      "declares more layers than it has bytes for")
    refused(counted:sub(1, at + 17) .. string.pack(">I2", 57) .. counted:sub(at + 20),
      "a layer has more than 56 channels")
    refused(paintings.psd { w = 2, h = 2, merged = "\0\2" .. ("\0"):rep(99) },
      "the merged picture is packed in an unknown way")
    fails_when_seen(paintings.psd { w = 2, h = 2, merged = "\0\0\1\2" }, "ends")
    refused(paintings.psd { w = 2, h = 2, merged = "\0\1\0\1\0" },
      "the table of the merged picture's row sizes is cut off")
    refused(paintings.psd { w = 2, h = 2, merged = "\0\1" .. ("\0\99"):rep(6) },
      "the merged picture is cut off")
    refused(psd { alpha = "\0\4" .. ("\0"):rep(99) }, "a channel is packed in an unknown way")
    refused(psd { alpha = "\0\1\0\1" }, "the table of a channel's row sizes is cut off")
  end)
end)

-- ---------------------------------------------------------------- archives

describe("an archive", function()
  local stack = '<image w="4" h="3"><stack><layer name="ink" src="a.png"/></stack></image>'
  local picture = paintings.png_of(4, 3, 8, 6, ("\0" .. ("\9\8\7\255"):rep(4)):rep(3))
  local function members(more)
    local list = { { name = "stack.xml", data = stack, deflate = true },
      { name = "a.png", data = picture } }
    for name, value in pairs(more or {}) do list[2][name] = value end
    return list
  end

  it_reads_archives("may have 64-bit numbers, extra fields and a comment", function()
    local plain = assert(seen(read(paintings.zip(members())))):bytes()
    assert.are.equal("\9\8\7\255", plain:sub(1, 4))
    for _, bytes in ipairs { paintings.zip(members(), "", true),
      paintings.zip(members(), ("c"):rep(9000), true), paintings.zip(members(), ("PK\5"):rep(9000)),
      paintings.zip(members { extra = string.pack("<I2I2", 0x5455, 3) .. "abc" }, "", true),
      paintings.zip(members { extra = "ab" }),
      paintings.zip(members { extra = string.pack("<I2I2", 1, 99) .. "abc" }),
      paintings.zip(members { extra = string.pack("<I2I2", 1, 0) }) } do
      assert.is_true(assert(seen(read(bytes))):bytes() == plain)
    end
  end)

  it_reads_archives("is refused if its 64-bit numbers are wrong", function()
    local wide = paintings.zip(members(), "", true)
    local locator = wide:find("PK\6\7", 1, true)
    refused(wide:sub(1, locator + 7) .. string.pack("<I8", 1 << 40) .. wide:sub(locator + 16),
      "the end of the table lies outside")
    refused(wide:sub(1, locator + 7) .. string.pack("<I8", 3) .. wide:sub(locator + 16),
      "the 64%-bit end of the table is missing")
    refused(wide:gsub("PK\6\7", "PK\6\8"), "the table of members lies outside")
    local wide_end = wide:find("PK\6\6", 1, true)
    refused(wide:sub(1, wide_end + 31) .. string.pack("<I8", 1 << 20) .. wide:sub(wide_end + 40),
      "1048576 members; at most 65536 are read")
    local function extra(data)
      return paintings.zip({ { name = "stack.xml", data = stack, size = 0xFFFFFFFF,
        extra = data } })
    end
    refused(extra(string.pack("<I2I2I4", 1, 4, 9)), "a member lies outside the archive")
    refused(extra(string.pack("<I2I2I8", 1, 8, -1)), "a member lies outside the archive")
    refused("PK\5\6" .. ("\0"):rep(4) .. ("\255"):rep(12) .. "\0\0", "lies outside")
  end)

  it_reads_archives("is refused if its table is damaged", function()
    local whole = paintings.zip(members())
    local entry = whole:find("PK\1\2", 1, true)
    refused(whole:gsub("PK\1\2", "PK\1\3", 1), "an entry of the table of members is damaged")
    refused(whole:sub(1, entry + 27) .. "\255\255" .. whole:sub(entry + 30),
      "an entry of the table of members is cut off")
    refused(whole:gsub("PK\3\4", "PK\3\5", 1), 'the header of "stack.xml" is missing')
    local local_name = whole:find("PK\3\4", 5, true)
    refused(whole:sub(1, local_name + 25) .. "\255\255" .. whole:sub(local_name + 28),
      '"a.png" is cut off')
    local many = whole:sub(1, -15) .. string.pack("<I2I2", 60000, 60000) .. whole:sub(-10)
    refused(many, "the table of members is too short")
    local function told_size(size, entries)
      return "PK" .. ("x"):rep((1 << 25) - 2) .. "PK\5\6"
        .. string.pack("<I2I2I2I2I4I4I2", 0, 0, entries, entries, size, 0, 0)
    end
    refused(told_size(1 << 25, 9), "the table of members has 33554432 bytes; at most %d+ are read")
    refused("PK\6\7" .. ("\0"):rep(16) .. "PK\5\6" .. ("\255"):rep(16) .. "\0\0",
      "byte 42: the file ends here; 14 more bytes are missing")
    refused("PQ" .. ("x"):rep(99), "is not a layered painting")
  end)
end)

-- ---------------------------------------------------------------- OpenRaster and its pictures

describe("an OpenRaster file", function()
  local rows = { [1] = "\0\0\0\0", [8] = "\0\1\2\3\4" }
  local function ora(content, more)
    local list = { { name = "stack.xml", data = '<image w="4" h="4">' .. content .. "</image>" },
      { name = "a.png", data = paintings.png_of(1, 1, 8, 6, "\0\9\8\7\255") } }
    for _, one in ipairs(more or {}) do list[#list + 1] = one end
    return paintings.zip(list)
  end

  it_reads_archives("reports the parts of its layers that are not shown", function()
    local tree =
      read(ora('<stack><text name="t"/><layer name="s" src="a.svg"/><unheard/><layer name="l" '
      .. 'src="a.png" visibility="hidden"/></stack>'))
    assert.are.same({ "t: text: it is empty" }, { told(tree)[1] })
    assert.matches("^s: ", told(tree)[2])
    assert.is_false(tree:find("l").visible)
    local shifted =
      read(ora('<stack><stack name="g" x="3" y="2"><layer name="l" src="a.png" '
      .. 'x="1"/></stack></stack>'))
    assert.matches("^g: ", told(shifted)[1])
    assert.are.same({ 1, 0 }, { shifted:find("g/l").x, shifted:find("g/l").y })
    local through = read(ora('<stack><stack name="g" isolation="auto"><layer src="a.png"/></stack>'
      .. '<stack name="h" isolation="auto" opacity=".5"/><stack name="i" '
      .. 'isolation="isolate"/></stack>'))
    assert.are.same({ "normal", "normal", "pass-through" },
      { through[1].blend, through[2].blend, through[3].blend })
  end)

  it_reads_archives("fails when a damaged PNG is shown", function()
    local function png(width, height, depth, colour, data, palette)
      return paintings.png_of(width, height, depth, colour, data, palette)
    end
    local function fails(picture, pattern)
      local bytes = ora('<stack><layer src="b.png"/></stack>',
        { { name = "b.png", data = picture } })
      local tree, message = layers.read(write(bytes))
      if tree then message = select(2, seen(tree)) end
      assert.matches(pattern, message)
    end
    fails((png(1, 1, 8, 6, rows[8]):gsub("IHDR", "IHDX")), "is not a PNG picture")
    for place = 27, 28 do
      local whole = png(1, 1, 8, 6, rows[8])
      fails(whole:sub(1, place - 1) .. "\1" .. whole:sub(place + 1), "its PNG header is damaged")
    end
    for _, form in ipairs { { 3, 0 }, { 16, 3 }, { 4, 2 }, { 8, 5 }, { 2, 6 }, { 1, 4 } } do
      fails(png(1, 1, form[1], form[2], rows[8]), "its PNG header is damaged")
    end
    local indexed = stored.chunk("PLTE", "\1\2\3")
    fails(png(1, 1, 8, 3, "\0\0", stored.chunk("PLTE", "\1\2")), "its palette is damaged")
    fails(png(1, 1, 8, 3, "\0\0", stored.chunk("PLTE", ("\1"):rep(771))), "its palette is damaged")
    fails(png(1, 1, 8, 3, "\0\0", indexed .. stored.chunk("tRNS", ("\1"):rep(300))),
      "its transparency is damaged")
    fails(png(1, 1, 8, 0, "\0\0", stored.chunk("tRNS", "\1")), "its transparency is damaged")
    fails(png(1, 1, 8, 2, "\0\0\0\0", stored.chunk("tRNS", "\1\2\3\4\5")),
      "its transparency is damaged")
  end)

  it_reads_archives("fails wherever one of its PNGs is cut off", function()
    local wide = ("\0" .. ("\1\2\3"):rep(2)):rep(2)
    local packed = stored.zlib(wide)
    local whole = "\x89PNG\r\n\x1a\n"
      .. stored.chunk("IHDR", string.pack(">I4I4BBBBB", 2, 2, 8, 2, 0, 0, 0))
      .. stored.chunk("iCCP", "name\0\0" .. stored.zlib(paintings.profile { curve = 1 }))
      .. stored.chunk("gAMA", "\0\0\xB1\x8F")
      .. stored.chunk("cHRM", ("\0"):rep(32)) .. stored.chunk("tEXt", "more")
      .. stored.chunk("PLTE", "\1\2\3")
      .. stored.chunk("tRNS", "\0\1\0\2\0\3") .. stored.chunk("IDAT", packed:sub(1, 9))
      .. stored.chunk("IDAT", packed:sub(10))
    local function try(size)
      local tree, message = layers.read(bench:write("cut.ora",
        ora('<stack><layer src="b.png"/></stack>',
        { { name = "b.png", data = whole:sub(1, size) } })))
      if tree then return seen(tree) end
      return nil, message
    end
    for size = 0, #whole - 9 do -- the checksums are not compared
      local image, message = try(size)
      assert.is_nil(image, size)
      assert.matches("%.ora: .", message)
    end
    -- its colour is the clear one
    assert.are.equal(("\0"):rep(8), assert(try(#whole)):bytes():sub(1, 8))
  end)

  it_reads_archives("is refused where its attributes are invalid", function()
    for attributes, pattern in pairs { ['x="nan"'] = 'x is "nan"',
      ['y="2e9"'] = 'y is "2e9"; it must be a number from', ['opacity="2"'] = "from 0 to 1",
      ['opacity="0.5x"'] = 'opacity is "0.5x"', ['opacity=""'] = 'opacity is ""' } do
      refused(ora('<stack><layer src="a.png" ' .. attributes .. "/></stack>"), pattern)
      refused(ora("<stack><stack " .. attributes .. "/></stack>"), pattern)
      refused(ora("<stack><text " .. attributes .. "/></stack>"), pattern)
    end
    for _, src in ipairs { "", "a\\b.png", "b/../../a.png", "b/..", "/a.png" } do
      refused(ora('<stack><layer src="' .. src .. '"/></stack>'), "it must lie in the archive")
    end
    refused(ora '<stack><layer src="..a.png"/></stack>', "which is not in the archive")
    local tree =
      read(ora('<stack><layer name="l" src="a" visibility="visible" composite-op="my:blend '
      .. 'mode_\xC3\xA4"/></stack>'))
    assert.is_true(tree[1].visible)
    assert.are.equal("blend?mode-??", tree[1].blend)
    assert.matches("^l: ", told(tree)[1])
    refused(paintings.zip { { name = "stack.xml", data = '<image w="4" h="x"/>' } }, 'h is "x"')
  end)

  it_reads_archives("has pictures of every depth of grey and of palettes", function()
    for depth, data in pairs { [1] = "\0\128", [2] = "\0\192", [4] = "\0\240", [8] = "\0\255",
      [16] = "\0\255\255" } do
      local tree = read(ora('<stack><layer src="b.png"/></stack>',
        { { name = "b.png", data = paintings.png_of(1, 1, depth, 0, data) } }))
      assert.are.equal("\255\255\255\255", assert(seen(tree)):bytes():sub(1, 4), depth)
      if depth < 16 then
        local palette = stored.chunk("PLTE", ("\1\2\3"):rep((1 << depth) - 1) .. "\9\8\7")
          .. stored.chunk("tRNS", "\0")
        tree = read(ora('<stack><layer src="b.png"/></stack>',
          { { name = "b.png", data = paintings.png_of(1, 1, depth, 3, data, palette) } }))
        assert.are.equal("\9\8\7\255", assert(seen(tree)):bytes():sub(1, 4), depth)
      end
    end
  end)

  it_reads_archives("has pictures of several pixels a byte, each row the sum of bytes", function()
    for depth, each in pairs { [1] = 8, [2] = 4, [4] = 2 } do
      local white = string.char((1 << depth) - 1 << (8 - depth))
      local tree = read(ora('<stack><layer src="b.png"/></stack>', { { name = "b.png",
        data = paintings.png_of(2 * each, 1, depth, 0, "\1" .. white .. "\0") } }))
      local image = assert(seen(tree))
      for x = 0, 3 do
        assert.are.equal(x % each == 0 and 1 or 0, (image:get(x, 0)), depth .. " " .. x)
      end
    end
  end)
end)

-- ---------------------------------------------------------------- Krita

describe("a Krita document", function()
  local HEAD = "VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE 4\nDATA %s\n"
  local function krita(tiles)
    return paintings.krita { w = 12, h = 10, layers = { layer_of { tiles = tiles } } }
  end

  it_reads_archives("is refused, or fails when it is shown, if its tiles are damaged", function()
    local cases = {
      { "", "too early" },
      { "VERSION 3\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE 4\nDATA 0\n", "unknown kind" },
      { "VERSION x\n", "the head of the layer's tiles is damaged" },
      { "VERSION 2\nTILEWIDTH 64\nTILEHEIGHT 64\nPIXELSIZE -4\nDATA 0\n", "head" },
      { "VERSION 2\nTILEWIDTH 64 \n", "head" }, { "VERSION 12345678901\n", "head" },
      { ("V"):rep(500), "a line of the layer's tiles is too long" },
      { HEAD:format "999" .. "0,0,LZF,1\n\0", "too early" },
    }
    for _, line in ipairs { "1,0,LZF,1\n\0", "0,7,LZF,1\n\0", "x,0,LZF,1\n\0", "0;0,LZF,1\n\0",
      "0,x,LZF,1\n\0", "0,0,LZF,x\n\0", "0,0,LZF,0\n\0",
      "0,0,LZF,99999\n\0", "0,0,LZF,1 \n\0" } do
      cases[#cases + 1] = { HEAD:format "1" .. line, "the line of a tile is damaged" }
    end
    for _, case in ipairs(cases) do
      local tree, message = layers.read(write(krita(case[1])))
      if tree then message = select(2, seen(tree)) end
      assert.is_string(message, case[1])
      assert.matches(case[2], message)
    end
  end)

  it_reads_archives("has the names of all blend modes, as Krita writes them", function()
    local words = { normal = "normal", multiply = "multiply", dodge = "color-dodge",
      burn = "color-burn", hard_light = "hard-light", soft_light = "soft-light-photoshop",
      soft_light_svg = "soft-light", diff = "difference", luminize = "luminosity",
      add = "linear-dodge", linear_dodge = "linear-dodge", dissolve = "dissolve",
      hard_mix_photoshop = "hard-mix", ["linear light"] = "linear-light",
      ["darker color"] = "darker-color", ["lighter color"] = "lighter-color",
      ["hard mix"] = "hard-mix-krita", grain_merge = "grain-merge" }
    for word, name in pairs(words) do
      local tree = read(paintings.krita { w = 12, h = 10, layers = { layer_of { blend = word } } })
      assert.are.equal(name, tree[1].blend)
      local is_shown = name ~= "hard-mix-krita" and name ~= "grain-merge"
      assert.are.equal(is_shown and 0 or 1, #tree.skipped)
    end
  end)

  it_reads_archives("dissolves layers, groups and clipped layers, with their opacity", function()
    local function solid(fields)
      local layer = { name = "ink", x = 0, y = 0, w = 12, h = 10, opacity = 0.6,
        pixel = function() return 250, 120, 0, 255 end }
      for name, value in pairs(fields) do layer[name] = value end
      return layer
    end
    local function pixels_of(object)
      return celspan.pixels(celspan.rostrum { celspan.cel { object } },
        { size = { 12, 10 } }):bytes()
    end
    local under = celspan.rect { 0, 0, 12, 10, texture = celspan.rgb(1, 1, 1) }
    local ink = solid { opacity = 1 }
    local whole = read(paintings.krita { w = 12, h = 10, layers = { ink } }).object
    local expected = pixels_of(celspan.dissolve(whole:fade(153 / 255)))
    assert.is_true(#expected:gsub("%z", "") > 100)
    for _, file in ipairs {
      paintings.krita { w = 12, h = 10, layers = { solid { blend = "dissolve" } } },
      paintings.openraster { w = 12, h = 10, layers = { solid { blend = "krita:dissolve" } } },
      paintings.psd { w = 12, h = 10, layers = { solid { blend = "diss" } } },
      paintings.krita { w = 12, h = 10, layers = { { name = "g", blend = "dissolve", opacity = 0.6,
        layers = { ink } } } } } do
      local tree = read(file)
      assert.same({}, told(tree))
      assert.equal("dissolve", tree[1].blend)
      assert.equal(expected, pixels_of(tree.object))
      assert.equal(expected, assert(seen(tree)):bytes())
      assert.equal(pixels_of(celspan.group { under, celspan.dissolve(whole:fade(153 / 255)) }),
        pixels_of(celspan.group { under, tree.object }))
    end
    local clipped = read(paintings.psd { w = 12, h = 10, layers = { ink, solid { blend = "diss",
      clipping = 1, pixel = function() return 0, 0, 255, 255 end } } })
    local blue = 0
    for x = 0, 11 do
      for y = 0, 9 do
        local r, _, b, a = celspan.pixels(celspan.rostrum { celspan.cel { clipped.object } },
          { size = { 12, 10 } }):get(x, y)
        assert.is_true(a == 1 and (b == 1 and r == 0 or b == 0 and r > 0.9))
        blue = blue + b
      end
    end
    assert.is_true(blue > 50 and blue < 95)
  end)

  it_reads_archives("may have layers without a tile, and tiles in any order", function()
    local empty = read(krita(HEAD:format "0"))
    assert.are.equal(("\0"):rep(4 * 12 * 10), assert(seen(empty)):bytes())
    local tile = "\0" .. ("\7"):rep(64 * 64) .. ("\8"):rep(64 * 64) .. ("\9"):rep(64 * 64)
      .. ("\255"):rep(64 * 64)
    local function at(x, y) return ("%d,%d,LZF,%d\n%s"):format(x, y, #tile, tile) end
    local ordered =
      assert(
        seen(read(krita(HEAD:format "4" .. at(0, 0) .. at(64, 0) .. at(-64, 64) .. at(0, 64)))))
        :bytes()
    local mixed =
      assert(
        seen(read(krita(HEAD:format "4" .. at(0, 64) .. at(64, 0) .. at(0, 0) .. at(-64, 64)))))
        :bytes()
    assert.are_not.equal(("\0"):rep(4 * 12 * 10), ordered)
    assert.is_true(ordered == mixed)
    assert.is_true(assert(seen(read(krita(HEAD:format "2" .. at(0, 0) .. at(0, 0))))):bytes()
      == ordered)
  end)

  it_reads_archives("reports the parts of its layers that are not shown", function()
    local function attributes(text)
      return told(read(paintings.krita { w = 12, h = 10,
        layers = { layer_of { attributes = text } } }))
    end
    assert.are.same({}, attributes ' channelflags="1111"')
    assert.are.same({}, attributes ' channelflags=""')
    assert.are.equal(1, #attributes ' channelflags="0111"')
    assert.are_not.same(attributes ' channelflags="0111"', attributes ' channelflags="1110"')
    local through = read(paintings.krita { w = 12, h = 10,
      layers = { { name = "g", attributes = ' passthrough="1"', layers = { layer_of() } } } })
    assert.are.equal("pass-through", through[1].blend)
    local plain = read(paintings.krita { w = 12, h = 10,
      layers = { layer_of { attributes = ' passthrough="1"' } } })
    assert.are.equal("normal", plain[1].blend)
    local masked = paintings.krita { w = 12, h = 10,
      layers = { layer_of { inside = '<masks><mask/><mask nodetype="filtermask"/></masks>' } } }
    assert.are.same({ 'ink: has a "mask": it changes nothing here',
      'ink: has a "filtermask": it changes nothing here' }, told(read(masked)))
  end)

  it_reads_archives("is refused where its attributes are invalid", function()
    local function attributes(fields)
      return paintings.krita { w = 12, h = 10, layers = { layer_of(fields) } }
    end
    refused(attributes { opacity = 2 }, 'opacity is "510"; it must be a number from 0 to 255')
    refused(attributes { x = 2000000000 }, 'x is "2000000000"')
    refused(attributes { y = -2000000000 }, 'y is "%-2000000000"')
    refused((paintings.zip {
      { name = "maindoc.xml", data = '<DOC><IMAGE width="4" height="x"/></DOC>' } }),
      'height is "x"')
    local function of(content, more)
      local list = {
        { name = "maindoc.xml", data = '<DOC><IMAGE width="4" height="4">' .. content
        .. "</IMAGE></DOC>" } }
      for _, one in ipairs(more or {}) do list[#list + 1] = one end
      return paintings.zip(list)
    end
    refused(of '<layer name="l"/>', 'filename is ""; it must name a layer')
    refused(of '<layer filename="a/b"/>', 'filename is "a/b"; it must name a layer')
    refused(of '<layer filename="a"/>', 'filename is "a", which is not in the archive')
    assert.are.same({}, told(read(of '<mask nodetype="selectionmask"/>')))
    local tiles = { name = "any/layers/a", data = HEAD:format "0" }
    assert.are.equal(1, #read(of('<layer filename="a"/>', { tiles })))
    for _, name in ipairs { "any/annotations/icc", "any/layers/a.icc",
      "any/layers/a.defaultpixel" } do
      refused(of('<layer filename="a"/>', { tiles, { name = name, data = "some bytes", sum = 1 } }),
        "its checksum is wrong")
    end
    local short = { name = "any/layers/a.defaultpixel", data = "abc" }
    assert.are.equal(1, #read(of('<layer filename="a"/>', { tiles, short })))
  end)
end)
