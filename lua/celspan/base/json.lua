--- A JSON reader (RFC 8259) with limits: for data and sheets, not for logs.
--
--   local cast = assert(json.read "cast.json")
--
-- Objects and arrays become tables, null becomes json.null. A name that is twice in an object has
-- its last value.
local core = require "celspan.core"

local json = { null = setmetatable({}, { __tostring = function() return "null" end }) }

--- Longer texts are refused, and deeper ones than 100 levels.
json.most_bytes = 64 * 1024 * 1024

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
  return core.json(text, json.null)
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
