-- The JSON reader: what it accepts, what it refuses, and its messages.
local json = require "celspan.json"

describe("json", function()
  it("reads every kind of value", function()
    assert.are.same({ 1, -2.5, 1e3, true, false, "x", {}, { a = { 1 } } },
      json.decode ' [1, -2.5, 1E+3, true, false, "x", [], {"a": [1]}] ')
    assert.are.equal(json.null, json.decode "null")
    assert.are.equal(0, json.decode "0")
  end)

  it("reads escapes and surrogate pairs", function()
    assert.are.equal('a"\\/\b\f\n\r\tä€😀\127', json.decode
      '"a\\"\\\\\\/\\b\\f\\n\\r\\t\\u00e4\\u20AC\\ud83d\\ude00\127"')
    assert.are.equal("\u{FFFD}x", json.decode '"\\ud83dx"')
  end)

  it("ignores a byte order mark", function()
    assert.are.equal(3, json.decode "\239\187\1913")
  end)

  it("refuses text that is not JSON, naming the line", function()
    for _, text in ipairs { "", " ", "[", "[1,]", "[1 2]", "{", '{"a"}', '{"a":}', "{a:1}", '"',
                            '"\\x"', '"\\u12"', '"\n"', "01", "-", "1.", "1.e3", ".5", "nul",
                            "tru", "True", "1 2", "NaN", "Infinity", "'x'", "[1]]" } do
      local value, message = json.decode(text)
      assert.is_nil(value, text)
      assert.is_truthy(message:find "^line %d+: ", text)
    end
    assert.are.equal("line 3: a comma or ] is missing in an array",
      select(2, json.decode "[1,\n2\n3]"))
  end)

  it("limits nesting, but not length", function()
    local deep = ("["):rep(200) .. ("]"):rep(200)
    assert.are.equal("line 1: nested deeper than 100 levels", select(2, json.decode(deep)))
    assert.is_truthy(json.decode(("["):rep(99) .. ("]"):rep(99)))
    assert.are.equal(20000, #json.decode("[" .. ("1,"):rep(19999) .. "1]"))
  end)

  it("writes objects in their order, or plain tables by their names", function()
    local ordered = { { "b", { list = { 1, "x\n" } } }, { "a", { } } }
    assert.equal('{\n  "b": [\n    1,\n    "x\\n"\n  ],\n  "a": {}\n}', json.encode(ordered))
    assert.equal('{"b":[1,"x\\n"],"a":{}}', json.encode(ordered, { compact = true }))
    local text = '{"a":[["k",1],[true]],"b":{"list":"z","n":null},"c":[]}'
    local plain = { plain = true, compact = true }
    local value = json.decode(text)
    value.c = { list = {} } -- an empty table is an object
    assert.equal(text, json.encode(value, plain))
  end)

  it("writes names in another order, and values in another form", function()
    local function value(one) return math.type(one) == "float" and ("%.1f"):format(one) or nil end
    local function is_before(a, b) return a > b end
    local options = { plain = true, compact = true, is_before = is_before, value = value }
    assert.equal('{"b":0.3,"a":[1,2.0]}', json.encode({ a = { 1, 2.0 }, b = 1 / 3 }, options))
    assert.has_error(function() json.encode({}, { plan = true }) end,
      "json.encode: unknown field 'plan'; did you mean 'plain'?")
  end)
end)
