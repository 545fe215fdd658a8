--- Checks the arguments of the library's functions, with the messages of the C constructors.
local native = require "celspan.native"

local fields = {}

--- The first unknown name in sorted order, so that messages do not depend on the table's order.
local function unknown_in(given, known)
  local least
  for name in next, given do
    if type(name) == "string" and not known[name] and (not least or name < least) then
      least = name
    end
  end
  return least
end

--- Whether a value is a number, but neither NaN nor infinite.
function fields.is_finite(value)
  return type(value) == "number" and value == value and value ~= math.huge and value ~= -math.huge
end

--- The finite number that a text means in decimal notation; nil for another text.
function fields.read_number(text)
  local number = not text:find "[xX]" and tonumber(text)
  return fields.is_finite(number) and number or nil
end

local booleans = { ["true"] = true, yes = true, ["1"] = true, ["false"] = false, no = false,
                   ["0"] = false }

--- The boolean that a text means, in upper or lower case; nil for another text.
function fields.read_boolean(text) return booleans[text:lower()] end

--- The texts that fields.read_boolean reads, for messages.
fields.booleans = "true, false, yes, no, 1 or 0"

--- The words with which a message describes a value: "nil", "a cel".
function fields.kind(value)
  local noun = type(value) == "userdata" and tostring(value):match "^(%l+)%f[{%z ]"
  return noun and "a " .. noun or type(value)
end

--- Whether a value is an object or a cel, which have bounds.
function fields.is_object(value)
  return type(value) == "userdata" and pcall(function() return value.bounds end)
end

--- The same as `kind`, with the value of a number.
function fields.shown(value)
  if value ~= value then return "nan" end -- the sign of NaN has no meaning
  return type(value) == "number" and ("%.14g"):format(value) or fields.kind(value)
end

--- What a message writes for a key: a string as it is, the kind of others.
function fields.key(value) return type(value) == "string" and value or fields.shown(value) end

--- Raises an error unless the option `space` is right or missing.
function fields.space(noun, space)
  if space ~= nil and space ~= "linear" and space ~= "srgb" then
    native.refuse(("%s: space must be \"linear\" or \"srgb\", got %s"):format(noun,
      type(space) == "string" and ("%q"):format(space) or fields.shown(space)))
  end
end

--- The end of a message about a name that is not among `names`: "; did you mean 'min'?"; nil if
--- none is near.
function fields.hint(name, names)
  local near = type(name) == "string" and native.nearest(name, names)
  return near and ("; did you mean '%s'?"):format(near) or nil
end

--- As fields.hint, but if no name is near, the end says all names; "" if there are none.
function fields.choice(name, names)
  return fields.hint(name, names)
    or #names > 0 and "; there are " .. table.concat(names, ", ") or ""
end

--- Raises an error: `noun` has no field or method of this name. The message suggests the nearest of
--- `names`.
local function refuse_name(noun, name, names)
  table.sort(names)
  native.refuse(("%s has no '%s'%s"):format(noun, name, fields.choice(name, names)))
end

--- Raises an error unless `holds`: a sentence, and the value that does not go with it. text: the
--- format of the sentence, for the arguments after it.
function fields.expect(holds, value, text, ...)
  if not holds then native.refuse(text:format(...) .. ", got " .. fields.shown(value)) end
end

--- The same, with the kind of the value alone.
function fields.expect_kind(holds, value, text, ...)
  if not holds then native.refuse(text:format(...) .. ", got " .. fields.kind(value)) end
end

--- Raises an error unless `holds`: `value` must be as `rule` says. what: "echo: field 'fade'".
function fields.must(holds, what, rule, value)
  fields.expect(holds, value, "%s must be %s", what, rule)
end

--- Raises an error unless `value` is a whole number from `least` to `most`, or with nil of at least
--- `least`. Returns it as an integer.
function fields.whole(what, value, least, most)
  local number = fields.is_finite(value) and math.tointeger(value)
  fields.must(number and number >= least and number <= (most or number), what,
    "a whole number " .. (most and ("from %d to %d"):format(least, most)
      or ("of at least %d"):format(least)), value)
  return number
end

--- Raises an error unless what a function takes has the wanted type(). what: a description of it.
function fields.takes(name, wanted, what, value)
  fields.expect_kind(type(value) == wanted, value, "%s takes %s", name, what)
end

--- The result of a function; nil and the message, if it raises a table with one.
function fields.caught(work, ...)
  local good, value = pcall(work, ...)
  if good then return value end
  if type(value) ~= "table" then error(value, 0) end
  return nil, value.message
end

local function with_subject(subject, good, value, ...)
  if good then return value, ... end
  if type(value) ~= "table" then error(value, 0) end
  return nil, ("%s: %s"):format(subject, value.message)
end

--- The results of a function; nil and the message, if it raises a table with one, after its
--- subject, such as the name of a file.
function fields.caught_in(subject, work, ...) return with_subject(subject, pcall(work, ...)) end

--- Raises an error unless the first argument of a function is an object.
function fields.object(noun, object)
  fields.expect_kind(fields.is_object(object), object, "%s: the first argument must be an object",
    noun)
end

--- Raises an error unless `self` is a value of this class (its metatable). Like all errors of the
--- library, it is at the line of the nearest caller outside the library.
function fields.self(noun, class, self, method)
  fields.expect_kind(getmetatable(self) == class, self,
    "%s: %s: call it as a method, value:%s(...)", noun, method, method)
end

--- Raises an error unless `self` is a value of this class, and `value`, the argument of its method
--- `at`, is a finite number. what: "a time".
function fields.check_at(noun, class, self, value, what)
  fields.self(noun, class, self, "at")
  fields.expect(fields.is_finite(value), value, "%s: at takes %s, a finite number", noun, what)
end

--- The __index of a class whose values have `methods`, and also fields. optional: the fields that
--- may be nil, as keys.
function fields.reads(noun, methods, optional)
  return function(value, name)
    local found = methods[name]
    local own = found == nil and type(name) == "string" and native.synonym(name, true)
    if own and (methods[own] or rawget(value, own)) then return methods[own] or value[own] end
    if found ~= nil or type(name) ~= "string" or optional and optional[name] then return found end
    local object = rawget(value, "object")
    if fields.is_object(object) and pcall(function() return object[name] end) then
      native.refuse(("%s has no '%s', but its object has: write .object:%s(...)"):format(noun, name,
        name))
    end
    local names = {}
    for _, list in ipairs { methods, value, optional or {} } do
      for known in pairs(list) do
        if type(known) == "string" and not known:find "^__" then names[#names + 1] = known end
      end
    end
    refuse_name(noun, name, names)
  end
end

--- A class of this name, whose methods are its own fields. noun: a value of it, as in "a track".
function fields.class(name, noun, optional)
  local class = { __name = name }
  class.__index = fields.reads(noun, class, optional)
  function class.__call()
    native.refuse(noun .. " is no function" .. (class.at and ": write value:at(...)" or ""))
  end
  return class
end

--- Makes it an error to read an unknown name of a module; returns the module.
function fields.seal(noun, module)
  local metatable = getmetatable(module) or {}
  metatable.__index = fields.reads("celspan." .. noun, {})
  return setmetatable(module, metatable)
end

--- Makes the functions of a table, except those for operators, keep the line of a caller that ends
--- with a call of them: `return layers.read(7)`.
local function keep_callers(methods)
  for name, method in next, methods do
    if type(method) == "function" and name:sub(1, 2) ~= "__" then
      methods[name] = native.entry(method)
    end
  end
end

--- fields.seal for a module that scripts use. More arguments: the methods of its classes.
function fields.publish(noun, module, ...)
  for _, methods in ipairs { module, ... } do keep_callers(methods) end
  return fields.seal(noun, module)
end

--- Raises an error unless `value` is a list of `count` finite numbers. subject: its name in the
--- message, with the number's index: "film[%d]"; shape: a description of valid values.
function fields.numbers(noun, subject, value, count, shape)
  fields.expect_kind(type(value) == "table", value, "%s: %s must be %s", noun,
    subject:match "^[^%[:]*", shape)
  for i = 1, count do
    local number = value[i]
    fields.expect(fields.is_finite(number), number, "%s: %s must be a %snumber", noun,
      subject:format(i), type(number) == "number" and "finite " or "")
  end
end

--- Whether nothing is wrong with the fields of a plain table: most are right, and are called often.
local function is_right(given, known)
  if getmetatable(given) or known[1] == nil and rawlen(given) > 0 then return false end
  for name, value in next, given do
    local wanted = type(name) == "string" and (known[name] or "none") or "any"
    if wanted ~= "any" and type(value) ~= wanted then return false end
    if wanted == "number" and not fields.is_finite(value) then return false end
  end
  return true
end

--- A copy of a table in which fields have celspan's spelling; the table, if all have it already.
local function settled(noun, given, known)
  local copy = given
  for name, value in next, given do
    local own = type(name) == "string" and not known[name] and native.synonym(name, true)
    if own and known[own] then
      if rawget(given, own) ~= nil then
        native.refuse(("%s: '%s' and '%s' are one field: give one of them"):format(noun, name, own))
      end
      if copy == given then
        copy = {}
        for key, one in next, given do copy[key] = one end
      end
      copy[name], copy[own] = nil, value
    end
  end
  return copy
end

--- Checks the fields of a table, and returns it, or a copy if fields of it are spelled in another
--- way. known: name -> the required type(), or "any". known[1] must be set if the table may contain
--- a list.
function fields.check(noun, given, known)
  fields.expect_kind(type(given) == "table", given, "%s: takes a table", noun)
  if is_right(given, known) then return given end
  given = settled(noun, given, known)
  local names = {}
  for name in pairs(known) do
    if type(name) == "string" then names[#names + 1] = name end
  end
  table.sort(names)
  local unknown = unknown_in(given, known)
  if unknown then
    native.refuse(("%s: unknown field '%s'%s"):format(noun, unknown,
      fields.hint(unknown, names) or "; the fields are " .. table.concat(names, ", ")))
  end
  if known[1] == nil and rawlen(given) > 0 then
    native.refuse(("%s: takes named fields only, but was given a list"):format(noun))
  end
  for _, name in ipairs(names) do
    local value = given[name]
    local wanted = known[name]
    fields.expect_kind(value == nil or wanted == "any" or type(value) == wanted, value,
      "%s: field '%s' must be a %s", noun, name, wanted)
    fields.expect(wanted ~= "number" or value == nil or fields.is_finite(value), value,
      "%s: field '%s' must be a finite number", noun, name)
  end
  return given
end

return fields
