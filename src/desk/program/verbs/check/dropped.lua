--- Values that a script makes and throws away: `c:scale(2)` as a statement changes nothing.
--
--   local c = celspan.circle { ... }    what is bound to a name has a type, by the annotations of
--   c = c:fade(0.5)                     celspan, if all that is bound to it has the same
--   c:scale(2)                          a statement that is the call of such a method
--
-- Only what is certain is reported: names that are parameters, or have values of two types, have
-- no type here, although they may have one when the script runs.
local program = ...
local celspan = require "celspan"
local files = require "celspan.files"
local manual = require "celspan.manual"
local native = require "celspan.native"
local ordered = require "celspan.ordered"
local tokens = program.part "tokens.lua"

--- Values that are immutable: of these classes and of those that extend them.
local VALUES = { ["celspan.object"] = true, ["celspan.cel"] = true, ["celspan.rostrum"] = true,
                 ["celspan.texture"] = true, ["celspan.paint"] = true, ["celspan.svg.art"] = true,
                 ["celspan.layers.tree"] = true }
local OPERATORS = {}
for sign in ("+ - * / // % ^ .. == ~= < > <= >= & | ~ << >> and or"):gmatch "%S+" do
  OPERATORS[sign] = true
end

local BYTES_MOST = 1 << 18 -- larger scripts are not examined: they are mostly data

local calls, parents = {}, {} -- filled from manual.types when a script needs them

--- The class of VALUES that a class extends; otherwise the class itself.
local function family(class)
  local at = class
  while at and not VALUES[at] do at = parents[at] end
  return at or class
end

local function returned(class, method)
  local at = class
  while at do
    local type_of = calls[at .. ":" .. method]
    if type_of then return type_of == "T" and class or type_of end
    at = parents[at]
  end
end

-- ---------------------------------------------------------------- chains

--- The state while a chain such as `celspan.circle { ... }:scale(2)` is read: `module` and `maker`
--- are names of celspan's, `class` is the class of a value; without any of them, nothing is known.
local function step(is, name, sign)
  if sign == "." then return { maker = is.module and is.module .. "." .. name } end
  local class = sign == ":" and is.class and returned(is.class, name)
    or sign == "(" and calls[is.maker or is.module]
  local is_ours = sign == ":" or (is.maker or ""):find "^celspan%.[%w_]+$"
  return { class = class and family(class), is_pure = class and is_ours and true }
end

local function is_arguments(token)
  return token and (token.kind == "(" or token.kind == "{" or token.kind == "string")
end

--- The place after the arguments at `at`, and their text in messages.
local function after_arguments(list, at)
  local token = list[at]
  if token.kind == "string" then return at + 1, " " .. token.text end
  return (token.partner or #list) + 1, token.kind == "(" and "(...)" or " {...}"
end

--- For `require "celspan"` at a place: the module, and the place after it.
local function required(list, at)
  local name = list[at + 1]
  if list[at].text ~= "require" or not name then return end
  local after = at + 2
  if name.kind == "(" then name, after = list[at + 2], name.partner and name.partner + 1 end
  local module = name and name.kind == "string" and name.text:match "^[\"'](.*)[\"']$"
  return module and after and { module = module }, after
end

--- The chain that begins with the name at a place: its state, the place after it, its text, and
--- whether it ends with a call.
local function chain_at(list, types, at)
  local is, after = required(list, at)
  if not is then is, after = types[list[at].text] or {}, at + 1 end
  local written, is_call = list[at].text, false
  while list[after] do
    local sign, name, shown = list[after].kind, list[after + 1], ""
    local is_named = (sign == "." or sign == ":") and name and name.kind == "name"
    if is_named then
      after, shown = after + 2, sign .. name.text
    elseif sign == "[" then
      after, is, shown = (list[after].partner or #list) + 1, {}, "[...]"
    elseif not is_arguments(list[after]) then
      break
    end
    is_call = sign ~= "." and sign ~= "["
    if is_call and is_arguments(list[after]) then
      local arguments
      after, arguments = after_arguments(list, after)
      shown = shown .. arguments
    end
    if sign ~= "[" then is = step(is, name and name.text, is_named and sign or "(") end
    written = written .. shown
  end
  return is, after, written, is_call
end

--- The type of the expression at a place, and the place after it; nil: not known.
local function expression_at(list, types, at)
  local token = list[at]
  local is, after
  if not token or token.kind ~= "name" then return nil end
  if token.text == "assert" and list[at + 1] and list[at + 1].kind == "(" then
    is = expression_at(list, types, at + 2)
    after = list[at + 1].partner and list[at + 1].partner + 1
  else
    is, after = chain_at(list, types, at)
  end
  if not after or list[after] and OPERATORS[list[after].kind] then return nil end
  return is, after
end

-- ---------------------------------------------------------------- names

--- Adds a binding to a name: the place of an expression and its index in a list; without a place,
--- the value is not known. The list part contains the names, in the order of the file.
local function bind(bindings, name, at, number)
  if not bindings[name] then bindings[name], bindings[#bindings + 1] = {}, name end
  table.insert(bindings[name], { at = at, number = number })
end

--- Binds the names between commas at a place, if a `=` follows them. Returns whether it does.
local function bind_list(list, bindings, at)
  local names = {}
  local kind
  repeat
    names[#names + 1] = list[at] and list[at].kind == "name" and list[at].text or nil
    at = at + 1
    if list[at] and list[at].kind == "<" then at = at + 3 end
    kind = list[at] and list[at].kind
    at = at + 1
  until kind ~= ","
  for i, name in ipairs(names) do
    if kind == "=" then bind(bindings, name, at, i) end
  end
  return kind == "="
end

--- Gives unknown values to all names from a place up to a token of one of these kinds.
local function bind_unknown(list, bindings, at, last)
  while list[at] and not last[list[at].kind] do
    if list[at].kind == "name" then bind(bindings, list[at].text) end
    at = at + 1
  end
end

--- Binds the names on the left of an assignment, if such a statement begins at a place. Values of
--- names that follow fields, as in `t.x, c = 1, 2`, are not examined.
local function bind_targets(list, bindings, at)
  local after = list[at + 1] and list[at + 1].kind
  if (after == "=" or after == ",") and bind_list(list, bindings, at) then return end
  local _, last = chain_at(list, {}, at)
  if list[last] and list[last].kind == "," then
    bind_unknown(list, bindings, at, { ["="] = true })
  end
end

--- The bindings of each name, in the whole file.
local function bindings_of(list)
  local bindings = {}
  for i, token in ipairs(list) do
    local after = list[i + 1] and list[i + 1].kind
    if token.kind == "local" and after == "name" then
      bind_list(list, bindings, i + 1)
    elseif token.is_first then
      bind_targets(list, bindings, i)
    elseif token.kind == "function" then
      bind_unknown(list, bindings, i + 1, { [")"] = true })
    elseif token.kind == "for" then
      bind_unknown(list, bindings, i + 1, { ["in"] = true, ["="] = true })
    end
  end
  return bindings
end

--- The type of an expression of a list.
local function item(list, types, binding)
  local is, after = nil, binding.at
  for i = 1, binding.number or 0 do
    if i > 1 and not (list[after] and list[after].kind == ",") then return nil end
    is, after = expression_at(list, types, i > 1 and after + 1 or after)
    if not is then return nil end
  end
  return is
end

local function is_same(a, b) return a and b and a.class == b.class and a.module == b.module end

--- The type that all bindings of a name have in common; nil: it is not known, or there are several.
--- is_sure: none may be unknown.
local function common(list, types, bindings, is_sure)
  local found
  for _, binding in ipairs(bindings) do
    local is = item(list, types, binding)
    local is_known = is and (is.class or is.module)
    if not binding.at or is_sure and not is_known then return nil end
    if is_known and found and not is_same(is, found) then return nil end
    found = is_known and is or found
  end
  return found
end

--- Visits the names until nothing changes: in the order of the file, because most names depend on
--- earlier ones. try(name, its bindings): returns whether it changed anything.
local function settle(bindings, try)
  local has_changed
  repeat
    has_changed = false
    for _, name in ipairs(bindings) do has_changed = try(name, bindings[name]) or has_changed end
  until not has_changed
end

--- Names and the types of their values: names of celspan, then the types that can be found, because
--- names depend on others; then names that also have an unknown value are left out.
local function types_of(list)
  local types, bindings, known, module_of = {}, bindings_of(list), native.names()
  for _, name in ipairs(known) do
    if not bindings[name] then
      types[name] = { module = module_of[name], maker = not module_of[name] and "celspan." .. name }
    end
  end
  settle(bindings, function(name, of_name)
    if types[name] then return false end
    types[name] = common(list, types, of_name, false)
    return types[name] ~= nil
  end)
  settle(bindings, function(name, of_name)
    if not types[name] then return false end
    if is_same(common(list, types, of_name, true), types[name]) then return false end
    types[name] = nil
    return true
  end)
  return types
end

-- ---------------------------------------------------------------- what is thrown away

local dropped = {}

local function sentence(name, types, is, written)
  local whole = types[name] and types[name].class
  if whole and whole == is.class then
    return ("%s makes a new value and does not change %s: write %s = %s"):format(written, name,
      name, written)
  end
  return written .. " makes a value that nothing uses: return it, give it a name, or put it into "
    .. "another value"
end

--- The places of statements that are calls, except for those of Lua's functions: most scripts have
--- few.
local function calls_of(list)
  local places = {}
  for i, token in ipairs(list) do
    if token.is_first and _G[token.text] == nil then
      local _, after, _, is_call = chain_at(list, {}, i)
      local follows = list[after] and list[after].kind
      if is_call and follows ~= "=" and follows ~= "," then places[#places + 1] = i end
    end
  end
  return places
end

local function modules_of(list)
  local modules = {}
  for i = 1, #list do
    local module = required(list, i)
    if module then modules[#modules + 1] = module.module end
  end
  return modules
end

--- Adds a sentence for each global of a text that hides a name of celspan.
local function add_hiding(sentences, path, text)
  local lines = native.assigned(text)
  for _, name in ipairs(ordered.names(lines)) do
    sentences[#sentences + 1] = ("%s:%d: the global '%s' hides celspan's %s in this file: make it "
      .. "local, or give it another name"):format(path, lines[name], name, name)
  end
end

local BEFORE = { ["="] = true, [","] = true, ["{"] = true, ["("] = true, ["or"] = true }
local AFTER = { [","] = true, ["}"] = true, [")"] = true, [";"] = true, ["or"] = true }

--- Adds a sentence for each name of a colour that stands for a value, as `fill = red` does for
--- `fill = "red"`, to the unquoted, and to its table `bound` the names with a value in this file.
local function add_unquoted(unquoted, path, list)
  for name in pairs(bindings_of(list)) do unquoted.bound[name] = true end
  for i, token in ipairs(list) do
    local is_value = token.kind == "name" and i > 1 and BEFORE[list[i - 1].kind]
      and AFTER[(list[i + 1] or token).kind]
    if is_value and _G[token.text] == nil and pcall(celspan.rgb, token.text) then
      local words = ("%s:%d: nothing has the name '%s' here; did you mean \"%s\", in quotes?")
        :format(path, token.line, token.text, token.text)
      unquoted[#unquoted + 1] = { name = token.text, sentence = words }
    end
  end
end

--- Adds a sentence, with the file's path, for each value that a text does not use, and each global
--- that hides a name. Returns the modules that the text requires.
local function add_dropped(sentences, path, text, list)
  add_hiding(sentences, path, text)
  local places = calls_of(list)
  if #places > 0 and not next(calls) then calls, parents = manual.types() end
  local types = #places > 0 and types_of(list)
  for _, i in ipairs(places) do
    local is, _, written = chain_at(list, types, i)
    if is.is_pure and VALUES[is.class] then
      sentences[#sentences + 1] = ("%s:%d: %s"):format(path, list[i].line,
        sentence(list[i].text, types, is, written))
    end
  end
  return modules_of(list)
end

--- text: of the file, if it has been read already.
local function add_file(sentences, unquoted, folder, path, is_seen, text)
  text = text or not is_seen[path] and files.read(path, BYTES_MOST)
  is_seen[path] = true
  if not text then return end
  local list = tokens.of(text)
  add_unquoted(unquoted, path, list)
  for _, name in ipairs(add_dropped(sentences, path, text, list)) do
    if name:find "^[%w_-][%w_.-]*$" then -- a dot at its beginning would lead to the root
      add_file(sentences, unquoted, folder, folder .. name:gsub("%.", "/") .. ".lua", is_seen)
    end
  end
end

--- A sentence, with file and line, for each value that is not used, each global that hides a name,
--- and each colour without quotes, in a script, or in modules beside it that it requires. text: of
--- the script, if it is not a file.
function dropped.of_script(path, text)
  local sentences, unquoted = {}, { bound = {} }
  if text and #text <= BYTES_MOST or program.has_ending(path, ".lua") then
    add_file(sentences, unquoted, path:match "^.*/" or "", path, {}, text)
  end
  for _, one in ipairs(unquoted) do
    if not unquoted.bound[one.name] then sentences[#sentences + 1] = one.sentence end
  end
  return sentences
end

return dropped
