-- Picture files of some kilobytes that declare gigabytes, made here byte by byte: whichever verb
-- opens one, the run ends soon, with the exit code of the table and a sentence that names the file,
-- and all of its processes together never used much memory. Faults that are visible in the header
-- are refused with --trust too, which opens pictures in the program itself.
local paintings = require "tests.support.paintings"
local present = require "tests.support.present"
local workbench = require "tests.support.workbench"

local PEAK = workbench.build .. "/tests/peak"

local MIB = 1 << 20
--- The program, the keeper and a decoder, with OpenImageIO loaded in two of them, hold 180 MiB.
local LOADED = 300 * MIB
local is_slow = present.sanitizer()

local bench

before_each(function() bench = workbench.new() end)
after_each(function() bench:remove() end)

-- ---------------------------------------------------------------- DPX

--- A film scan whose header declares these numbers of pixels, and of bytes for other programs;
--- 400 bytes follow.
local function dpx(fields)
  local element = (">I4I4fI4fBBBBI2I2I4I4I4c32"):pack(0, 0, 0, 255, 1, fields.descriptor or 50,
    2, 2, fields.bits or 8, 0, fields.encoding or 0, 2048, 0, 0, "")
  return (">c4I4c8I4I4I4I4I4c624I4c104"):pack("SDPX", 2048, "V1.0", 0xffffffff, 1, 1664, 384,
      fields.user or 0, "", 0xffffffff, "")
    .. (">I2I2I4I4"):pack(0, 1, fields.width or 16, fields.height or 16) .. element:rep(8)
    .. ("\0"):rep(52 + 256 + 384 + 400)
end

-- ---------------------------------------------------------------- Photoshop

--- A document of this size; layers, resources and pixels: the bytes of those sections.
local function psd(fields)
  local is_large = fields.is_large
  local side = fields.side or 8
  return (">c4I2c6I2I4I4I2I2"):pack("8BPS", is_large and 2 or 1, "", fields.channels or 3, side,
      side, 8, 3)
    .. (fields.colours or (">I4"):pack(0)) .. (">s4"):pack(fields.resources or "")
    .. (is_large and ">s8" or ">s4"):pack(fields.layers or "")
    .. (">I2"):pack(fields.packing or 0) .. (fields.pixels or ("\0"):rep(3 * 64))
end

--- A section of `count` layers of 30,000 x 30,000 pixels and 56 channels, without a byte of them.
local function layers(count)
  local channels = {}
  for i = 0, 55 do channels[#channels + 1] = (">I2I4"):pack(i, 3) end
  local record = (">i4i4i4i4I2"):pack(0, 0, 30000, 30000, 56) .. table.concat(channels)
    .. (">c8BBBBI4I4I4I4"):pack("8BIMnorm", 255, 0, 0, 0, 12, 0, 0, 0)
  return (">s4I4"):pack((">i2"):pack(count) .. record:rep(count) .. ("\0"):rep(200), 0)
end

--- A JPEG file of side x side pixels, of which some bytes are there: the rest is grey.
local function jpeg(side)
  local parts = { "\xff\xd8\xff\xdb\0\67\0" .. ("\1"):rep(64),
    (">c2I2BI2I2B"):pack("\xff\xc0", 17, 8, side, side, 3) .. "\1\17\0\2\17\0\3\17\0" }
  for _, table_number in ipairs { "\x00", "\x10" } do -- one code, of one bit, in each table
    parts[#parts + 1] = "\xff\xc4\0\20" .. table_number .. "\1" .. ("\0"):rep(16)
  end
  return table.concat(parts) .. "\xff\xda\0\12\3\1\0\2\0\3\0\0\63\0" .. ("\0"):rep(23000)
end

--- A resource; the name and the data have an even number of bytes.
local function resource(number, name, data)
  return "8BIM" .. (">I2s1"):pack(number, name) .. (#name % 2 == 0 and "\0" or "")
    .. (">s4"):pack(data) .. (#data % 2 == 1 and "\0" or "")
end

local function thumbnail(number, side, data)
  local row = (side * 24 + 31) // 32 * 4
  local head = (">I4I4I4I4I4I4I2I2"):pack(1, side, side, row, row * side, #data, 24, 1)
  return resource(number, "", head .. data)
end

--- A resource whose length points outside the file, so that a reader that follows it sees nothing
--- more.
local astray = "8BIM" .. (">I2I2I4"):pack(1000, 0, 0x7fffffff)

-- ---------------------------------------------------------------- what becomes of them

local TOO_MUCH = "decoding it needs more than 256 MiB, or than the system has (--limit picture-m"
local TRUNCATED = "is corrupt or truncated"
local ROWS = "is damaged: its layers have more rows than the file has bytes"
local function sgi(storage, rows, channels)
  return (">I2BBI2I2I2I2"):pack(474, storage, 1, 3, 4, rows, channels) .. ("\0"):rep(600)
end
local LONGER = "is damaged: a part of it is longer than the file"
local caption = resource(1008, "told", "odd")
local zeros = ("\0"):rep(24000)

--- Name, bytes, exit code (0: it is read), sentence. `is_decoded`: refused because of what a
--- decoder may use, so not with --trust.
local pictures = {
  { "user.dpx", dpx { user = 0xc0000000 }, 4,
    "is damaged: its header declares more user data than the file has bytes" },
  { "wide.dpx", dpx { width = 1048576, height = 260, descriptor = 51, bits = 16 }, 4, TRUNCATED },
  { "packed.dpx", dpx { width = 1048576, height = 1048576, descriptor = 51, bits = 10,
    encoding = 1 }, 4, TRUNCATED },
  { "interlaced.png", paintings.png_of(16384, 8192, 16, 6, ("\0"):rep(20000), "", 1), 33, TOO_MUCH,
    is_decoded = true },
  { "rows.sgi", sgi(1, 65535, 65535), 4,
    "is damaged: its header declares more rows than the file has bytes" },
  { "storage.sgi", sgi(2, 4, 3), 4, "is damaged: its rows are stored in an unknown way" },
  { "layers.psd", psd { layers = layers(60) }, 4, ROWS },
  { "astray.psd", psd { resources = astray, layers = layers(60) }, 4, LONGER },
  { "colours.psd", psd { colours = (">I4"):pack(0xfffffff0) }, 4, LONGER },
  { "thumbnail.psd", psd { resources = caption .. thumbnail(1036, 32000, jpeg(32000)) }, 0 },
  { "old-thumbnail.psd", psd { resources = thumbnail(1033, 32000, jpeg(32000)) }, 0 },
  { "thumbnails.psd", psd { resources = thumbnail(1036, 1, ""):rep(400) }, 4,
    "is damaged: it has more than 16 thumbnails" },
  { "merged.psd", psd { side = 16384, channels = 56, packing = 1, pixels = zeros }, 4,
    "end of file" },
  { "large.psd", psd { side = 300000, channels = 56, packing = 1, is_large = true,
    pixels = zeros }, 6, "is 300000 x 300000 pixels in a format that can only be read whole" },
}

--- Runs celspan; returns the exit code, messages, and the bytes of all processes.
local function watched(arguments)
  local code, _, err = bench:shell(("cd '%s' && '%s' 60 '%s' %s")
    :format(bench.folder, PEAK, workbench.absolute, arguments))
  local words, bytes = err:match "^(.*)peak (%d+) processor [%d.]+\n$"
  assert.is_truthy(words, err)
  return code, words, tonumber(bytes)
end

local function check(picture, arguments, most)
  local code, words, bytes = watched(arguments)
  local where = ("%s: exit code %d, %d MiB: %s"):format(arguments, code, bytes // MIB, words)
  if words:find "built without OpenImageIO" or words:find "celspan%-picture" then
    return pending(words)
  end
  assert.are.equal(picture[3], code, where)
  if code ~= 0 then
    assert.is_truthy(words:find("^celspan: error: "), where)
    assert.is_truthy(words:find(picture[1] .. ": ", 1, true), where)
    assert.is_truthy(words:find(picture[4], 1, true), where)
  end
  if is_slow then return end
  assert.is_true(bytes < most, where)
end

describe("a picture file of some kilobytes that declares gigabytes,", function()
  for _, picture in ipairs(pictures) do
    if not (is_slow and picture.is_decoded) then
      local becomes = picture[3] == 0 and ", is read as if it did not" or ", is refused"
      it(picture[1] .. becomes, function()
        assert.is_true(#picture[2] < 25600)
        bench:write(picture[1], picture[2])
        bench:write("film.lua", ([[local celspan = require "celspan"
return celspan.rostrum { size = { 8, 8 },
  celspan.cel { celspan.image { file = "%s", w = 8 } } }]]):format(picture[1]))
        local limit = " --limit picture-memory=256M"
        local most = LOADED + (picture.is_decoded and 256 * MIB or 0)
        for _, arguments in ipairs { "convert " .. picture[1] .. " --size 16x16 out.png",
                                     "render film.lua --progress none -o frame.png" } do
          check(picture, arguments .. limit, most)
          if not picture.is_decoded then check(picture, arguments .. " --trust", most) end
        end
        assert.are.equal(picture[3] == 0, bench:read "out.png" ~= nil)
        assert.are.equal(picture[3] == 0, bench:read "frame.png" ~= nil)
      end)
    end
  end
end)
