--- Checking the table that a function of the library is given, in the words of the C constructors.
local core = require "celspan.core"

local fields = {}

--- The least unknown name, so that what is reported does not depend on the order of the table.
local function unknown_in(given, known)
  local least
  for name in pairs(given) do
    if type(name) == "string" and not known[name] and (not least or name < least) then
      least = name
    end
  end
  return least
end

--- Whether it is a number that is neither NaN nor infinite.
function fields.is_finite(value)
  return type(value) == "number" and value == value and value ~= math.huge and value ~= -math.huge
end

--- What a message says was given: the value of a number, else the type.
function fields.shown(value)
  return type(value) == "number" and ("%.14g"):format(value) or type(value)
end

--- Raises at the line of the caller's caller, or at `level`. known: name -> what type() must give.
function fields.check(noun, given, known, level)
  level = level or 3
  if type(given) ~= "table" then
    error(("%s: takes a table, got %s"):format(noun, type(given)), level)
  end
  local names = {}
  for name in pairs(known) do names[#names + 1] = name end
  table.sort(names)
  local unknown = unknown_in(given, known)
  if unknown then
    local hint = core.nearest(unknown, names)
    error(("%s: unknown field '%s'%s"):format(noun, unknown,
      hint and ("; did you mean '%s'?"):format(hint)
        or "; the fields are " .. table.concat(names, ", ")), level)
  end
  for _, name in ipairs(names) do
    local value = given[name]
    local wanted = known[name]
    if value ~= nil and wanted ~= "any" and type(value) ~= wanted then
      error(("%s: field '%s' must be a %s, got %s"):format(noun, name, wanted, type(value)), level)
    end
    if wanted == "number" and value ~= nil and not fields.is_finite(value) then
      error(("%s: field '%s' must be a finite number, got %s"):format(noun, name,
        fields.shown(value)), level)
    end
  end
end

return fields
