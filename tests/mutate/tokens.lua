-- Tokens of C, as far as mutants need them: words, numbers, texts and marks, each with its
-- position. Comments, directives and code that only self-checks compile are left out.
local tokens = {}

-- Longest first.
local MARKS = {
  "<<=", ">>=", "...",
  "->", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&", "||",
  "+=", "-=", "*=", "/=", "%=", "&=", "|=", "^=", "##",
}

--- The end of the text or character that begins at `at`.
local function end_of_text(text, at)
  local quote = text:sub(at, at)
  local i = at + 1
  while text:sub(i, i) ~= quote and i <= #text do
    i = i + (text:sub(i, i) == "\\" and 2 or 1)
  end
  return i
end

--- The end of the directive that begins at `at`, including continued lines.
local function end_of_directive(text, at)
  local stop = at
  repeat
    stop = text:find("\n", stop + 1, true) or #text + 1
  until text:sub(stop - 1, stop - 1) ~= "\\"
  return stop
end

--- The last byte that is left out from `#ifdef CELSPAN_CHECKS` at `at`: that before its #else or
--- #endif.
local function after_checks(text, at)
  local depth = 0
  for place, name in text:sub(at):gmatch "()#%s*(%a+)" do
    if name:find "^if" then depth = depth + 1 end
    if name == "endif" then depth = depth - 1 end
    if depth == 0 or depth == 1 and name == "else" then return at + place - 2 end
  end
  return #text + 1
end

local function mark_at(text, at)
  for _, mark in ipairs(MARKS) do
    if text:sub(at, at + #mark - 1) == mark then return mark end
  end
  return text:sub(at, at)
end

--- The token at `at`, where no white space is: its kind (nil if it is left out), and its last byte.
local function token_at(text, at)
  local two, one = text:sub(at, at + 1), text:sub(at, at)
  if two == "//" then return nil, (text:find("\n", at, true) or #text + 1) - 1 end
  if two == "/*" then return nil, select(2, text:find("*/", at + 2, true)) or #text end
  if one == "#" then
    if text:find("^#%s*ifdef%s+CELSPAN_CHECKS", at) then return nil, after_checks(text, at) end
    return nil, end_of_directive(text, at) - 1
  end
  if one == '"' or one == "'" then return "text", end_of_text(text, at) end
  if text:find("^%.?%d", at) then
    local stop = select(2, text:find("^0[xX][%x.]+", at)) or select(2, text:find("^[%d.]+", at))
    stop = select(2, text:find("^[eEpP][+-]?%d+", stop + 1)) or stop
    return "number", select(2, text:find("^%w*", stop + 1))
  end
  local stop = select(2, text:find("^[%a_][%w_]*", at))
  if stop then return "word", stop end
  return "mark", at + #mark_at(text, at) - 1
end

local CLOSES = { ["("] = ")", ["["] = "]", ["{"] = "}" }

--- Gives each bracket the index of its partner, `pair`.
local function join_brackets(list)
  local open = {}
  for i, token in ipairs(list) do
    if token.kind == "mark" and CLOSES[token.text] then open[#open + 1] = i end
    local last = list[open[#open]]
    if last and token.kind == "mark" and CLOSES[last.text] == token.text then
      last.pair, token.pair = i, table.remove(open)
    end
  end
end

--- The tokens of a source: { kind, text, from, to (bytes, both included), pair (of brackets) }.
function tokens.read(text)
  local list, at = {}, 1
  while true do
    at = text:find("%S", at)
    if not at then break end
    local kind, stop = token_at(text, at)
    if kind then
      list[#list + 1] = { kind = kind, text = text:sub(at, stop), from = at, to = stop }
    end
    at = stop + 1
  end
  join_brackets(list)
  return list
end

return tokens
