--- The words of a Lua script: what `dropped.lua` looks at. The script has been compiled before.
--
--   c:scale(2) -- big     c  :  scale  (  2  )      comments are left out
--
-- INVARIANT: a bracket knows the place of its partner (`partner`), and a name whether a statement
-- begins with it (`is_first`): in Lua a value follows another only where a statement ends.
local tokens = {}

local KEYWORDS = {}
for word in ([[and break do else elseif end false for function goto if in local nil not or repeat
  return then true until while]]):gmatch "%a+" do
  KEYWORDS[word] = true
end

--- After these tokens, a name begins a statement; after all others it continues one.
local ENDS = { name = true, number = true, string = true, [")"] = true, ["]"] = true, ["}"] = true,
               ["end"] = true, ["nil"] = true, ["true"] = true, ["false"] = true, ["..."] = true,
               ["break"] = true, [";"] = true, ["do"] = true, ["then"] = true, ["else"] = true,
               ["repeat"] = true, ["::"] = true }

local PAIRS = { [".."] = true, ["::"] = true, ["=="] = true, ["~="] = true, ["<="] = true,
                [">="] = true, ["//"] = true, ["<<"] = true, [">>"] = true }

--- The place after a text in long brackets that begins at `at`; nil: there is none.
local function after_long(text, at)
  local level = text:match("^%[(=*)%[", at)
  if not level then return nil end
  local _, last = text:find("]" .. level .. "]", at, true)
  return (last or #text) + 1
end

local function after_quoted(text, at)
  local quote = text:sub(at, at)
  at = at + 1
  while at <= #text and text:sub(at, at) ~= quote do
    at = at + (text:sub(at, at) == "\\" and 2 or 1)
  end
  return at + 1
end

local function after_comment(text, at)
  return after_long(text, at + 2) or text:find("\n", at, true) or #text + 1
end

--- The kind of the token at a place, and the place after it. The kinds are "name", "number" and
--- "string"; the kind of any other token is its text.
local function read(text, at)
  local word = text:match("^[%a_][%w_]*", at)
  if word then return KEYWORDS[word] and word or "name", at + #word end
  local number = text:match("^%.?%d[%w_.]*", at)
  if number then
    local sign = number:find "^0[xX]" and "[pP]$" or "[eE]$"
    local power = number:find(sign) and text:match("^[+-]%d+", at + #number) or ""
    return "number", at + #number + #power
  end
  local sign = text:sub(at, at)
  if sign == '"' or sign == "'" then return "string", after_quoted(text, at) end
  local long = sign == "[" and after_long(text, at)
  if long then return "string", long end
  local pair = text:sub(at, at + 1)
  if not PAIRS[pair] then return sign, at + 1 end
  if pair == ".." and text:sub(at + 2, at + 2) == "." then return "...", at + 3 end
  return pair, at + 2
end

local OPENS = { ["("] = ")", ["["] = "]", ["{"] = "}", ["function"] = "end", ["do"] = "end",
                ["if"] = "end", ["repeat"] = "until" }
local CLOSES = { [")"] = true, ["]"] = true, ["}"] = true, ["end"] = true, ["until"] = true }
local IS_BRACKET = { ["("] = true, ["["] = true, ["{"] = true }

--- Sets `partner` and `is_first` of the last token of a list. open: the places of brackets that are
--- open.
local function place(list, open)
  local token, before = list[#list], list[#list - 1]
  local outer = list[open[#open]]
  token.is_first = token.kind == "name" and not (outer and IS_BRACKET[outer.kind])
    and (not before or ENDS[before.kind] or false)
  if CLOSES[token.kind] and outer then
    outer.partner = #list
    open[#open] = nil
  elseif OPENS[token.kind] then
    open[#open + 1] = #list
  end
end

--- The tokens of a text: kind, text, line, partner, is_first.
function tokens.of(text)
  local list, open, at, line = {}, {}, text:match "^#[^\n]*()" or 1, 1
  local newline = text:find("\n", 1, true)
  while true do
    local start = text:match("^%s*()", at)
    if start > #text then return list end
    while newline and newline < start do
      line, newline = line + 1, text:find("\n", newline + 1, true)
    end
    if text:sub(start, start + 1) == "--" then
      at = after_comment(text, start)
    else
      local kind, after = read(text, start)
      list[#list + 1] = { kind = kind, text = text:sub(start, after - 1), line = line }
      place(list, open)
      at = after
    end
  end
end

return tokens
