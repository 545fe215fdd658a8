--- A JSON reader (RFC 8259) with limits: for data and sheets, not for logs.
--
--   local cast = assert(json.read "cast.json")
--
-- Objects and arrays become tables, null becomes json.null. A name that is twice in an object has
-- its last value.
local json = { null = setmetatable({}, { __tostring = function() return "null" end }) }

--- Texts that are deeper or longer are refused.
json.most_depth = 100
json.most_bytes = 64 * 1024 * 1024

local escapes = { ['"'] = '"', ["\\"] = "\\", ["/"] = "/", b = "\b", f = "\f", n = "\n",
                  r = "\r", t = "\t" }
local words = { ["true"] = true, ["false"] = false, ["null"] = json.null }

local function fail(text, at, what)
  local _, lines = text:sub(1, at - 1):gsub("\n", "")
  error({ message = ("line %d: %s"):format(lines + 1, what) }, 0)
end

local function skip(text, at)
  return text:find("[^ \t\r\n]", at) or #text + 1
end

--- Reads a \u escape. at: the position of the u. Surrogate pairs are joined.
local function read_unicode(text, at)
  local digits = text:match("^u(%x%x%x%x)", at)
  if not digits then fail(text, at, "\\u needs four hexadecimal digits") end
  local code = tonumber(digits, 16)
  local low = code >= 0xD800 and code < 0xDC00 and text:match("^\\u([dD][c-fC-F]%x%x)", at + 5)
  if low then
    return utf8.char(0x10000 + (code - 0xD800) * 0x400 + tonumber(low, 16) - 0xDC00), at + 11
  end
  if code >= 0xD800 and code < 0xE000 then code = 0xFFFD end -- half a pair
  return utf8.char(code), at + 5
end

local function read_string(text, at)
  local parts, start = {}, at + 1
  at = start
  while true do
    at = text:find('["\\%c]', at)
    local sign = at and text:sub(at, at)
    if sign == '"' then break end
    if sign ~= "\\" and sign ~= "\127" then
      fail(text, at or #text, at and "a control character in a string"
        or "a string does not end")
    end
    if sign == "\127" then
      at = at + 1
    else
      parts[#parts + 1] = text:sub(start, at - 1)
      local letter = text:sub(at + 1, at + 1)
      if letter == "u" then
        parts[#parts + 1], at = read_unicode(text, at + 1)
      else
        parts[#parts + 1] = escapes[letter] or fail(text, at, "unknown escape in a string")
        at = at + 2
      end
      start = at
    end
  end
  parts[#parts + 1] = text:sub(start, at - 1)
  return table.concat(parts), at + 1
end

local function read_number(text, at)
  local digits = text:match("^-?%d+%.?%d*[eE]?[+-]?%d*", at)
  local good = digits and not (digits:find "^-?0%d" or digits:find "%.$" or digits:find "%.[eE]")
  local number = good and tonumber(digits)
  if not number then fail(text, at, "a value is missing or not JSON") end
  return number, at + #digits
end

local read_value

local function read_array(text, at, depth)
  local array = {}
  at = skip(text, at + 1)
  if text:sub(at, at) == "]" then return array, at + 1 end
  while true do
    array[#array + 1], at = read_value(text, at, depth)
    at = skip(text, at)
    local sign = text:sub(at, at)
    if sign == "]" then return array, at + 1 end
    if sign ~= "," then fail(text, at, "a comma or ] is missing in an array") end
    at = at + 1
  end
end

local function read_object(text, at, depth)
  local object = {}
  at = skip(text, at + 1)
  if text:sub(at, at) == "}" then return object, at + 1 end
  while true do
    at = skip(text, at)
    if text:sub(at, at) ~= '"' then fail(text, at, "a name in quotes is missing in an object") end
    local name
    name, at = read_string(text, at)
    at = skip(text, at)
    if text:sub(at, at) ~= ":" then fail(text, at, "a colon is missing in an object") end
    object[name], at = read_value(text, at + 1, depth)
    at = skip(text, at)
    local sign = text:sub(at, at)
    if sign == "}" then return object, at + 1 end
    if sign ~= "," then fail(text, at, "a comma or } is missing in an object") end
    at = at + 1
  end
end

function read_value(text, at, depth)
  if depth >= json.most_depth then
    fail(text, at, ("nested deeper than %d levels"):format(json.most_depth))
  end
  at = skip(text, at)
  local sign = text:sub(at, at)
  if sign == "{" then return read_object(text, at, depth + 1) end
  if sign == "[" then return read_array(text, at, depth + 1) end
  if sign == '"' then return read_string(text, at) end
  local word = text:match("^%a+", at)
  if word and words[word] ~= nil then return words[word], at + #word end
  return read_number(text, at)
end

--- Reads a value from a text.
---@param text string
---@return any value
---@return string? message
function json.decode(text)
  if type(text) ~= "string" then
    error("json: decode takes a string, got " .. type(text), 2)
  end
  if #text > json.most_bytes then
    return nil, ("the text has %d bytes; at most %d are read"):format(#text, json.most_bytes)
  end
  local start = text:find "^\239\187\191" and 4 or 1 -- a byte order mark is skipped
  local good, value, at = pcall(read_value, text, start, 0)
  if not good then
    return nil, type(value) == "table" and value.message or tostring(value)
  end
  at = skip(text, at)
  if at <= #text then
    local _, problem = pcall(fail, text, at, "something follows the value")
    return nil, problem.message
  end
  return value
end

--- Reads a value from a file.
---@param path string Relative to the caller's file, else to the script
---@return any value
---@return string? message
function json.read(path)
  if type(path) ~= "string" then error("json: read takes a file name, got " .. type(path), 2) end
  local text, message = require "celspan.files".read_found(path, json.most_bytes)
  if not text then return nil, message end
  local value, problem = json.decode(text)
  if value == nil then return nil, ("%s: %s"):format(path, problem) end
  return value
end

-- ---------------------------------------------------------------- writing

local shorts = { ['"'] = '\\"', ["\\"] = "\\\\", ["\n"] = "\\n", ["\t"] = "\\t" }

local function encode_text(text)
  return '"' .. text:gsub('[%c"\\]', function(c)
    return shorts[c] or ("\\u%04x"):format(c:byte())
  end) .. '"'
end

--- Writes a value as JSON. Objects are lists of { name, value }, so that they keep their order; a
--- list has the field `list`.
---@param value any
---@param indent? string Before every line but the first; default ""
---@return string text
function json.encode(value, indent)
  if type(value) ~= "table" then
    return type(value) == "string" and encode_text(value) or tostring(value)
  end
  indent = indent or ""
  local inner, items = indent .. "  ", {}
  for i, item in ipairs(value.list or value) do
    items[i] = inner .. (value.list and json.encode(item, inner)
      or encode_text(item[1]) .. ": " .. json.encode(item[2], inner))
  end
  local open, close = value.list and "[" or "{", value.list and "]" or "}"
  if #items == 0 then return open .. close end
  return ("%s\n%s\n%s%s"):format(open, table.concat(items, ",\n"), indent, close)
end

return require "celspan.fields".seal("json", json)
