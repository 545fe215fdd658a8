--- A JSON reader (RFC 8259) with limits: for data and sheets, not for logs.
--
--   local cast = assert(json.read "cast.json")
--
-- Objects and arrays become tables, null becomes json.null. A name that is twice in an object has
-- its last value.
local native = require "celspan.native"
local fields = require "celspan.fields"

local json = { null = setmetatable({}, { __tostring = function() return "null" end }) }

--- Longer texts are refused, and deeper ones than 100 levels.
json.most_bytes = 64 * 1024 * 1024

--- Reads a value from a text.
---@param text string
---@return any value
---@return string? message
function json.decode(text)
  fields.takes("json: decode", "string", "a string", text)
  if #text > json.most_bytes then
    return nil, ("the text has %d bytes; at most %d are read"):format(#text, json.most_bytes)
  end
  return native.json(text, json.null)
end

--- Reads a value from a file.
---@param path string Relative to the caller's file, else to the script
---@return any value
---@return string? message
function json.read(path)
  fields.takes("json: read", "string", "a file name", path)
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

local function by_name(a, b) return a < b end

--- The items of a list, and true; or the members of an object, each a name and a value.
local function parts_of(value, options)
  local list = value.list
  if not options.plain then return list or value, list ~= nil end
  if type(list) == "table" and (list[1] ~= nil or next(list) == nil) then return list, true end
  if value[1] ~= nil then return value, true end
  local names, members = {}, {}
  for name in pairs(value) do names[#names + 1] = name end
  table.sort(names, options.is_before or by_name)
  for i, name in ipairs(names) do members[i] = { name, value[name] } end
  return members, false
end

--- line: between the parts of the table that contains the value; "" in compact texts.
local function encode(value, options, line)
  local given = options.value and options.value(value)
  if given then return given end
  if type(value) == "string" then return encode_text(value) end
  if type(value) ~= "table" or value == json.null then return tostring(value) end
  local parts, is_list = parts_of(value, options)
  local inner, colon = line .. "  ", ": "
  if options.compact then inner, colon = "", ":" end
  local texts = {}
  for i, part in ipairs(parts) do
    texts[i] = is_list and encode(part, options, inner)
      or encode_text(part[1]) .. colon .. encode(part[2], options, inner)
  end
  local open, close = is_list and "[" or "{", is_list and "]" or "}"
  if #texts == 0 then return open .. close end
  return open .. inner .. table.concat(texts, "," .. inner) .. line .. close
end

local OPTIONS = { plain = "boolean", compact = "boolean", is_before = "function",
                  value = "function" }

--- Writes a value as JSON. Objects are lists of { name, value }, so that they keep their order; a
--- list has the field `list`. plain: tables are as `decode` returns them. compact: without spaces.
---@param value any
---@param options? { plain?: boolean, compact?: boolean, is_before?: fun(a: string, b: string): boolean, value?: fun(value: any): string? }
---@return string text
function json.encode(value, options)
  options = options or {}
  fields.check("json.encode", options, OPTIONS)
  return encode(value, options, options.compact and "" or "\n")
end

return fields.seal("json", json)
