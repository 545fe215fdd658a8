-- Finds the executable parts of a C source: expressions, conditions and statements. Declarations,
-- types, labels and assertions are skipped.
--
-- It is not a parser: it is right for sources in the project's style, and a mistake gives a mutant
-- that does not compile.
local code = {}

local function set(words)
  local list = {}
  for word in words:gmatch "%S+" do list[word] = true end
  return list
end

local ASSERTIONS = set "assert static_assert _Static_assert CS_SELF_CHECK"
local QUALIFIERS = set [[const static unsigned signed struct union enum volatile register extern
  inline long short]]
local TYPES = set [[void char int float double bool unsigned signed long short const struct size_t
  FILE lua_State lua_Number lua_Integer]]

code.keywords = set "if while for switch return sizeof case do else goto _Alignof"

--- Whether a word names a type.
local function is_type(word)
  return TYPES[word] or word:find "_t$" or word:find "^celspan_" or word:find "^cs_"
end

--- Whether the tokens between the brackets i and j are a type, as in a cast.
local function is_type_name(list, i, j)
  if j == i + 1 then return false end
  for k = i + 1, j - 1 do
    local token = list[k]
    if token.text ~= "*" and token.kind ~= "word" then return false end
  end
  if list[i + 1].kind ~= "word" then return false end
  return list[j - 1].text == "*" or is_type(list[i + 1].text)
end

--- Whether the bracket at i, which is `)`, ends a cast.
local function ends_cast(list, i)
  local open = list[i].pair
  local before = list[open - 1]
  if before and before.kind == "word" and not code.keywords[before.text] then return false end
  return before.text ~= "sizeof" and is_type_name(list, open, i)
end

--- Whether the mark at i is between two operands.
function code.is_binary(list, i)
  local before, after = list[i - 1], list[i + 1]
  if after.text == ")" or after.text == "," then return false end
  if before.kind == "number" then return true end
  if before.kind == "word" then return not code.keywords[before.text] end
  return before.text == "]" or before.text == ")" and not ends_cast(list, i - 1)
end

--- The end of a statement that begins at i: the index of its `;`.
local function semicolon(list, i, last)
  while i <= last and list[i].text ~= ";" do
    i = (list[i].pair and list[i].pair > i and list[i].pair or i) + 1
  end
  return i
end

--- Whether the statement at i declares something.
local function is_declaration(list, i)
  if QUALIFIERS[list[i].text] then return true end
  if list[i].kind ~= "word" then return false end
  local k = i + 1
  while list[k].text == "*" or list[k].text == "const" do k = k + 1 end
  local after = list[k + 1].text
  return list[k].kind == "word" and (after == "=" or after == ";" or after == "," or after == "[")
end

--- Passes on the initial values of a declaration from i to its semicolon.
local function initial_values(list, i, stop, see)
  local from
  while i <= stop do
    local text = list[i].text
    if from and (text == "," or text == ";") then
      see.expression(from, i - 1)
      from = nil
    elseif not from and text == "=" then
      from = i + 1
    end
    i = (list[i].pair and list[i].pair > i and list[i].pair or i) + 1
  end
end

local statements

--- A statement of an expression or a declaration; the index after it.
local function plain_statement(list, i, last, see)
  local stop = semicolon(list, i, last)
  if ASSERTIONS[list[i].text] then return stop + 1 end
  if stop == i then return i + 1 end
  if is_declaration(list, i) then
    initial_values(list, i, stop, see)
  else
    see.expression(i, stop - 1)
    see.statement(i, stop)
  end
  return stop + 1
end

--- `for (...)` with its opening bracket at i; the index after it.
local function for_clauses(list, i, see)
  local close = list[i].pair
  local first = semicolon(list, i + 1, close)
  local second = semicolon(list, first + 1, close)
  if first > i + 1 and is_declaration(list, i + 1) then
    initial_values(list, i + 1, first, see)
  elseif first > i + 1 then
    see.expression(i + 1, first - 1)
  end
  if second > first + 1 then see.expression(first + 1, second - 1) end
  if close > second + 1 then see.expression(second + 1, close - 1) end
  return close + 1
end

local readers = {}

local function condition(list, i, _, see)
  local close = list[i + 1].pair
  see.expression(i + 2, close - 1)
  see.condition(i + 2, close - 1)
  return close + 1
end

readers["if"] = condition
readers["while"] = condition

readers["switch"] = function(list, i, _, see)
  see.expression(i + 2, list[i + 1].pair - 1)
  return list[i + 1].pair + 1
end

readers["for"] = function(list, i, _, see) return for_clauses(list, i + 1, see) end

readers["else"] = function(_, i) return i + 1 end
readers["do"] = readers["else"]

readers["case"] = function(list, i)
  while list[i].text ~= ":" do i = i + 1 end
  return i + 1
end
readers["default"] = readers["case"]

readers["goto"] = function(list, i, last) return semicolon(list, i, last) + 1 end

readers["return"] = function(list, i, last, see)
  local stop = semicolon(list, i, last)
  if stop > i + 1 then see.expression(i + 1, stop - 1) else see.statement(i, stop) end
  return stop + 1
end

readers["break"] = function(list, i, last, see)
  see.statement(i, i + 1)
  return semicolon(list, i, last) + 1
end
readers["continue"] = readers["break"]

readers["{"] = function(list, i, _, see)
  statements(list, i + 1, list[i].pair - 1, see)
  return list[i].pair + 1
end

--- The statements from i to `last`.
function statements(list, i, last, see)
  while i <= last do
    local token = list[i]
    local is_label = token.kind == "word" and list[i + 1].text == ":" and token.text ~= "default"
    if is_label then
      i = i + 2
    else
      i = (readers[token.text] or plain_statement)(list, i, last, see)
    end
  end
end

--- Walks the executable parts of the source of these tokens, and calls functions of `see` with the
--- first and last index:
---   expression(i, j)   each complete expression, not its parts
---   condition(i, j)    that of an if or a while, in addition to its expression
---   statement(i, j)    a statement that can be dropped, including its semicolon
function code.walk(list, see)
  local i = 1
  while i <= #list do
    local token = list[i]
    if token.text == "{" and list[i - 1].text == ")" then
      statements(list, i + 1, token.pair - 1, see)
      i = token.pair + 1
    elseif token.text == "=" then
      local stop = semicolon(list, i, #list)
      see.expression(i + 1, stop - 1)
      i = stop + 1
    else
      i = (token.pair and token.pair > i and token.pair or i) + 1
    end
  end
end

return code
