-- Numbers and texts at the limits of their range: the result is a sentence or a picture, never a
-- crash, and nothing unwanted reaches a terminal or a file.
local celspan = require "celspan"
local raised = require "tests.support.raised"
local workbench = require "tests.support.workbench"

local function still() return celspan.rostrum { celspan.cel { celspan.rect { 0, 0, 4, 4 } } } end

describe("extreme numbers", function()
  it("are refused as the numbers of frames", function()
    local film = celspan.film { size = { 4, 4 }, frames = 3, frame = still }
    for _, number in ipairs { math.mininteger, math.maxinteger, -1, 3, 4, 1e300, 0 / 0, 1.5 } do
      if number ~= 3 then
        local message = raised.message(film.at, film, number)
        assert.is_truthy(message:find("at: ", 1, true) or message:find("frame", 1, true), message)
      end
    end
  end)

  it("may be floats of whole value as numbers of pixels", function()
    local image = assert(celspan.pixels(still(), { size = { 8, 8 } }))
    assert.are.same({ image:get(3, 1) }, { image:get(3.0, 1) })
    assert.are.same({ image:get(7, 0) }, { image:get(7.0, 0.0) })
    for _, x in ipairs { 8, 8.0, -1, 1e300, math.mininteger, 0 / 0, 2.5 } do
      assert.is_string(raised.message(image.get, image, x, 1))
    end
  end)

  it("are refused as angles, moves and sizes", function()
    local rect = celspan.rect { 0, 0, 1, 1 }
    for _, call in ipairs {
      function() return rect:rotate(1e300) end, function() return rect:translate(1e300, 0) end,
      function() return rect:scale(1e300) end, function() return rect:skew(1e300, 0) end,
      function() return celspan.rect { 1e300, 0, 1, 1 } end,
      function()
        return celspan.stroke { points = { { 0, 0 }, { 1, 1 } }, dash = { 1 }, dash_offset = 1e300 }
      end,
      function() return rect:rotate(0 / 0) end, function() return rect:translate(1 / 0, 0) end,
    } do
      local sentence = raised.sentence(call)
      assert.is_truthy(sentence:find("must be", 1, true), sentence)
    end
  end)
end)

describe("output of a script", function()
  local bench
  before_each(function() bench = workbench.new() end)
  after_each(function() bench:remove() end)

  it("reaches the terminal without control characters, its further lines indented", function()
    bench:write("loud.lua", [[error("one\27[31mred\7\r\ntwo\0three\127")]])
    local code, _, err = bench:celspan("render '%s/loud.lua' -o '%s/a.png' --progress none",
      bench.folder, bench.folder)
    assert.are.equal(3, code)
    assert.is_nil((err:gsub("\n", "")):find "%c", ("%q"):format(err))
    local first, rest = err:match "^([^\n]*)\n(.*)$"
    assert.is_truthy(first:find("one\\x1b[31mred\\x07\\x0d", 1, true), err)
    for line in rest:gmatch "[^\n]+" do assert.are.equal("    ", line:sub(1, 4)) end
  end)

  it("does not appear in the header of a DPX, nor does the folder", function()
    bench:write("still.lua", [[local celspan = require "celspan"
return celspan.rostrum { size = { 8, 8 }, celspan.cel { celspan.rect { 0, 0, 4, 4 } } }]])
    local code, _, err = bench:celspan("render '%s/still.lua' -o '%s/a.dpx' --progress none",
      bench.folder, bench.folder)
    if code == 2 or err:find("cannot be written", 1, true) then
      return pending "DPX cannot be written here"
    end
    assert.are.equal(0, code, err)
    local bytes = bench:read "a.dpx"
    assert.is_nil(bytes:find(bench.folder, 1, true))
    assert.is_nil(bytes:find(bench.folder:match "[^/]*$", 1, true))
  end)

  it("ends with 0 if standard output is closed and nothing is written to it", function()
    bench:write("still.lua", [[local celspan = require "celspan"
return celspan.rostrum { size = { 8, 8 }, celspan.cel { celspan.rect { 0, 0, 4, 4 } } }]])
    local whole = ("'%s' render %s/still.lua -o %s/%%s.png --progress none")
      :format(bench.binary, bench.folder,
      bench.folder)
    assert.are.equal(0, (bench:shell(whole:format "open")))
    assert.are.equal(0, (bench:shell(whole:format "closed" .. " >&-")))
    assert.are.equal(bench:read "open.png", bench:read "closed.png")
    assert.are.equal(5,
      (bench:shell(("'%s' probe %s/still.lua 1 1 >&-"):format(bench.binary, bench.folder))))
  end)
end)
