--- Values of files, which anybody may have written. A failure is a table with a message, for
--- fields.caught. where: the object with the value, for messages: "layer 2: ", "timeTables[1].".
local fields = require "celspan.fields"
local json = require "celspan.json"

local values = {}

local MESSAGE_BYTES = 400 -- longer messages quote a file of another kind

function values.fail(...)
  local message = string.format(...)
  if #message > MESSAGE_BYTES then
    message = message:sub(1, MESSAGE_BYTES):gsub("[\192-\255][\128-\191]*$", "") .. " ..."
  end
  error({ message = message }, 0)
end

local WORDS = { table = "list" }

--- object[name], which has the wanted type(). One that is missing or null is the default; without
--- a default it must be there.
function values.get(object, where, name, wanted, default)
  local value = object[name]
  if value == nil or value == json.null then
    if default == nil then values.fail("%s%s is missing", where, name) end
    return default
  end
  if type(value) ~= wanted then
    values.fail("%s%s must be a %s, got %s", where, name, WORDS[wanted] or wanted,
      fields.kind(value))
  end
  return value
end

function values.number(object, where, name, least, most, default)
  local number = values.get(object, where, name, "number", default)
  if not (number >= least and number <= most) then
    values.fail("%s%s must be a number from %.10g to %.10g, got %s", where, name, least, most,
      fields.shown(number))
  end
  return number
end

function values.whole(object, where, name, least, most, default)
  local number = values.get(object, where, name, "number", default)
  if number ~= math.floor(number) or number < least or number > most then
    values.fail("%s%s must be a whole number from %d to %d, got %s", where, name, least, most,
      fields.shown(number))
  end
  return math.tointeger(number)
end

--- Each object of a list, and where it is. form: of this place, such as "layer %d: ".
function values.each(object, where, name, default, form)
  local list, i = values.get(object, where, name, "table", default), 0
  return function()
    i = i + 1
    local item = list[i]
    if item == nil then return nil end
    local here = where .. (form or name .. "[%d]."):format(i)
    if type(item) ~= "table" or item == json.null then
      values.fail("%s must be an object, got %s", here:gsub("[.: ]*$", ""), fields.kind(item))
    end
    return item, here
  end
end

--- An object in a text of JSON. what: its name in the message.
function values.decode(text, what)
  local document, problem = json.decode(text)
  if document == nil then values.fail("%s", problem) end
  if type(document) ~= "table" or document == json.null then
    values.fail("%s must be an object, got %s", what, fields.kind(document))
  end
  return document
end

--- A table, or an empty one for any other value.
function values.table(value) return type(value) == "table" and value or {} end

--- A text that is not empty, or nil.
function values.text(value) return type(value) == "string" and value ~= "" and value or nil end

--- Adds a sentence to the list `skipped` of what is read.
function values.skip(read, ...) table.insert(read.skipped, string.format(...)) end

return fields.seal("values", values)
