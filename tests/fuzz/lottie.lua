--- Any bytes as a Lottie animation: objects at every frame and a film, or nil and a sentence that
--- names the file. What follows the first zero byte changes the JSON before it: three bytes each
--- choose a value of the text and what it is replaced by.
local lottie = require "celspan.lottie"

local target = {}

local path = os.tmpname()
local MOST_CHANGES, MOST_LENGTH = 16, 1 << 17
local hostile = {
  "null", "[]", "{}", "0", "-1", "1e308", "-1e308", "1e-320", "0.5", "255", "100000", "true",
  "\"x\"", "\"#fff\"", "[null]", "[[]]", "[0,0]", "[1e308,-1e308,1e308]", "[{\"t\":0}]",
  "[{\"t\":0,\"s\":[1]},{\"t\":0,\"s\":[9]}]", "{\"a\":1,\"k\":[]}", "{\"k\":{\"k\":1}}",
  "[{\"t\":5,\"s\":[0,0],\"e\":[9,9],\"i\":{\"x\":2,\"y\":-9},\"o\":{\"x\":-1,\"y\":9}},{\"t\":3}]",
  "{\"x\":\"wiggle()\"}",
}

local function write(bytes)
  local file = assert(io.open(path, "wb"))
  file:write(bytes)
  file:close()
end

local patterns = { ["["] = "^%b[]", ["{"] = "^%b{}", ["\""] = "^\"[^\"]*\"" }

--- The places { first, last } of all values of a JSON text, as far as it is one.
local function values_of(text)
  local places = {}
  for at, c in text:gmatch "()([%[{\"%-%dtfn])" do
    local first, last = text:find(patterns[c] or "^[%w%.%+%-]+", at)
    if first and not text:find("^%s*:", last + 1) then places[#places + 1] = { first, last } end
  end
  return places
end

--- Replaces a value by a hostile one, or by another value of the text.
local function change(text, which, what)
  local places = values_of(text)
  if #places == 0 then return text end
  local place = places[which % #places + 1]
  local new = hostile[what + 1]
  if not new then
    local other = places[(which * 31 + what) % #places + 1]
    new = text:sub(other[1], other[2])
  end
  return text:sub(1, place[1] - 1) .. new .. text:sub(place[2] + 1)
end

local function changed(bytes)
  local text, choices = bytes:match "^({[^%z]*)%z(.*)$"
  if not text then return bytes end
  for i = 1, math.min(#choices - 2, 3 * MOST_CHANGES), 3 do
    text = change(text, (choices:byte(i) << 8) + choices:byte(i + 1), choices:byte(i + 2))
    if #text > MOST_LENGTH then break end
  end
  return text
end

--- The animation, if the bytes are one.
function target.try_bytes(bytes)
  write(changed(bytes))
  local art, message = lottie.read(path)
  os.remove(path)
  if not art then
    assert(message:find(path, 1, true) and #message < #path + 500,
      "no sentence that names the file")
    return
  end
  for _, frame in ipairs { art.first, (art.first + art.last) / 2, art.last, -1e300, 1e300, 7 } do
    assert(type(art:at(frame)) == "userdata", "a frame without an object")
  end
  assert(art:film().frames >= 1, "a film without frames")
  assert(#art.skipped <= 1001, "too many lines")
  for _, line in ipairs(art.skipped) do assert(#line < 2000 and utf8.len(line), "a bad line") end
  return art
end

return target
