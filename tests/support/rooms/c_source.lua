--- Reads the structure of C and C++ sources: the includes and definitions of a file.
---
---   local file = c_source.read "src/core/engine/sweep/active.c"
---
--- file.lines      how many there are
--- file.includes   names between quotes
--- file.functions  { name, line, last, parameters, is_static, from, to }: those that have a body,
---                 which is the tokens from..to
--- file.types      { kind, is_typedef, name, line }: struct, union, enum, class with a name
--- file.names      { kind, name, line, owner }: of types, fields, functions, prototypes,
---                 enumerators, macros
--- file.text       the tokens, without comments and directives; file.line: their lines
local c_tokens = require "tests.support.rooms.c_tokens"

local c_source = {}

-- ---------------------------------------------------------------- declarations

local DECORATION = { __attribute__ = true, _Alignas = true, alignas = true, __declspec = true }

local function is_word(word) return word ~= nil and word:find "^[%a_]" ~= nil end

--- The positions of the tokens of a range, except attributes and tokens inside brackets.
local function outline(file, from, to)
  local list, i = {}, from
  while i <= to do
    if DECORATION[file.text[i]] and file.text[i + 1] == "(" then
      i = file.close[i + 1]
    else
      list[#list + 1] = i
      i = file.close[i] or i
    end
    i = i + 1
  end
  return list
end

local function find(file, list, ...)
  for place, i in ipairs(list) do
    for _, word in ipairs { ... } do
      if file.text[i] == word then return place end
    end
  end
end

local function add_name(file, kind, name, i, owner)
  file.names[#file.names + 1] = { kind = kind, name = name, line = file.line[i], owner = owner }
end

--- The name before the first bracket of an outline, and the place where its parameters begin.
local function signature(file, list)
  local place = find(file, list, "(")
  if not place or place == 1 then return end
  local i = list[place]
  local word = file.text[i - 1]
  if word == "CS_WIDE" then return file.text[i + 1], list[place + 1] end
  if word == "CS_WIDE_DECLARE" then
    local inner = outline(file, i + 1, file.close[i] - 1)
    return file.text[inner[find(file, inner, ",") + 1]], inner[find(file, inner, "(")]
  end
  if file.text[i + 1] == "*" and file.text[i + 3] == "(" then -- it returns a pointer to an array
    return file.text[i + 2], i + 3
  end
  return is_word(word) and word or nil, i
end

local function count_parameters(file, open)
  local list = outline(file, open + 1, file.close[open] - 1)
  if #list == 0 or #list == 1 and file.text[list[1]] == "void" then return 0 end
  local count = 1
  for _, i in ipairs(list) do count = count + (file.text[i] == "," and 1 or 0) end
  return count
end

local function add_function(file, from, brace)
  local list = outline(file, from, brace - 1)
  local name, open = signature(file, list)
  assert(name, ("%s:%d: what is this?"):format(file.path, file.line[from]))
  local last = file.close[brace]
  file.functions[#file.functions + 1] = { name = name, line = file.line[from],
    last = file.line[last], parameters = count_parameters(file, open),
    is_static = find(file, list, "static") ~= nil, from = brace, to = last }
  add_name(file, "function", name, from)
end

--- The names of a declaration's variables, fields or typedefs: each before a comma, a bracket, ...
local function add_declared(file, list, kind, owner)
  local name
  for place, i in ipairs(list) do
    local word, after = file.text[i], file.text[list[place + 1] or 0]
    if word == "(" and file.text[i + 1] == "*" and after == "(" then
      add_name(file, kind, file.text[file.close[i] - 1], i, owner)
      return
    elseif is_word(word) and place > 1 then
      name = i
    end
    if name and (after == nil or after == "," or after == ":" or after == "[") then
      add_name(file, kind, file.text[name], name, owner)
      name = nil
      if after == ":" then return end
    end
  end
end

local function add_enumerators(file, brace)
  local is_next = true
  for _, i in ipairs(outline(file, brace + 1, file.close[brace] - 1)) do
    if is_next then add_name(file, "enumerator", file.text[i], i) end
    is_next = file.text[i] == ","
  end
end

local parse

--- A type with a body: from its first token to before the semicolon.
local function add_type(file, from, brace, to)
  local head, tail = outline(file, from, brace - 1), outline(file, file.close[brace] + 1, to)
  local place = find(file, head, "struct", "union", "enum", "class")
  local word = file.text[head[place]]
  if file.text[head[place + 1] or 0] == "class" then place = place + 1 end
  local name = head[place + 1]
  local is_typedef = file.text[from] == "typedef"
  if is_typedef then name = tail[#tail] end
  if name then
    file.types[#file.types + 1] = { kind = word, is_typedef = is_typedef, name = file.text[name],
                                    line = file.line[from] }
    add_name(file, "type", file.text[name], name)
  end
  if word == "enum" then return add_enumerators(file, brace) end
  parse(file, brace + 1, file.close[brace] - 1, name and file.text[name] or "")
end

--- A declaration that ends with a semicolon, at the top (owner == nil) or in a struct.
local function add_declaration(file, from, to, owner)
  local list = outline(file, from, to)
  local first = file.text[from]
  if #list == 0 or first == "using" or first == "_Static_assert" or first == "static_assert" then
    return
  end
  local has_parameters = find(file, list, "(")
  if first == "typedef" then
    add_declared(file, list, "type")
  elseif owner then
    add_declared(file, list, "field", owner)
  elseif has_parameters and not find(file, list, "=") then
    local name = signature(file, list)
    if name then add_name(file, "prototype", name, from) end
  end
end

--- The kind of the block that a brace opens, as the tokens before it show.
local function classify(file, from, brace)
  local list = outline(file, from, brace - 1)
  if find(file, list, "=") then return "value" end
  if find(file, list, "(") then return "function" end
  if find(file, list, "struct", "union", "enum", "class") then return "type" end
  return "transparent" -- namespaces, extern "C"
end

function parse(file, from, to, owner)
  local i, start, brace = from, from, nil
  while i <= to do
    local word = file.text[i]
    if word == ";" then
      if brace then
        add_type(file, start, brace, i - 1)
        if owner then -- its variables are fields
          local tail = outline(file, file.close[brace], i - 1)
          add_declared(file, tail, "field", owner)
        end
      else
        add_declaration(file, start, i - 1, owner)
      end
      start, brace = i + 1, nil
    elseif word == "{" then
      local kind = classify(file, start, i)
      if kind == "function" then
        add_function(file, start, i)
        start = file.close[i] + 1
      elseif kind == "transparent" then
        start = i + 1
      elseif kind == "type" then
        brace = i
      end
      i = kind == "transparent" and i or file.close[i]
    elseif word == "}" then -- the end of a transparent block
      start = i + 1
    elseif owner and word == ":" and file.text[i - 1]:find "^p[ru][ibo]%a+" then
      start = i + 1 -- public:
    else
      i = file.close[i] or i
    end
    i = i + 1
  end
end

function c_source.read(path)
  local handle = assert(io.open(path, "rb"))
  local text = handle:read "a"
  handle:close()
  local file = { path = path, lines = select(2, text:gsub("\n", "")), includes = {}, functions = {},
                 types = {}, names = {}, text = {}, line = {}, close = {} }
  c_tokens.cut(file, text)
  parse(file, 1, #file.text)
  return file
end

return c_source
