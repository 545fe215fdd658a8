--- Splits C and C++ sources into tokens: words, numbers, signs; all strings become `""`.
local c_tokens = {}

local OPEN = { ["("] = ")", ["["] = "]", ["{"] = "}" }

--- The kind of the token at `at`, and its end.
local function token_end(text, at)
  local first = text:sub(at, at)
  if first:find "[%a_]" then return "word", select(2, text:find("^[%w_]+", at)) end
  if first:find "%d" then return "number", select(2, text:find("^[%w_.]+", at)) end
  if first:find "%s" then return "blank", select(2, text:find("^%s+", at)) end
  local two = text:sub(at, at + 1)
  if two == "//" then return "blank", select(2, text:find("^[^\n]*", at)) end
  if two == "/*" then return "blank", select(2, text:find("*/", at + 2, true)) end
  if first == '"' or first == "'" then
    local last = at
    repeat
      last = text:find("[\\" .. first .. "]", last + 1)
      local is_escape = text:sub(last, last) == "\\"
      if is_escape then last = last + 1 end
    until not is_escape
    return "string", last
  end
  if text:find("^%.%.%.", at) then return "sign", at + 2 end
  if two == "->" or two == "::" or two == "==" or two == "<=" or two == ">=" or two == "!=" then
    return "sign", at + 1
  end
  return "sign", at
end

local function read_directive(file, words, line)
  local include = words:match '^#%s*include%s*"([^"]+)"'
  if include then file.includes[#file.includes + 1] = { name = include, line = line } end
  local macro = words:match "^#%s*define%s+([%a_][%w_]*)"
  if macro and not words:find "^#%s*define%s+[%w_]+_H%s*$" then
    file.names[#file.names + 1] = { kind = "macro", name = macro, line = line }
  end
end

--- Fills file.text, the tokens without comments and directives, file.line, their lines, and
--- file.close: for an opening bracket the token that closes it. Also file.includes, and macros in
--- file.names.
function c_tokens.cut(file, text)
  local at, line, is_first = 1, 1, true -- is_first: nothing but blanks before it on its line
  local open = {}
  while at <= #text do
    local kind, last = token_end(text, at)
    local word = text:sub(at, last)
    if is_first and word == "#" then
      last = at
      repeat
        last = text:find("\n", last + 1, true) or #text
      until text:sub(last - 1, last - 1) ~= "\\"
      last = last - 1
      word = text:sub(at, last)
      read_directive(file, word, line)
    elseif kind ~= "blank" then
      local n = #file.text + 1
      file.text[n], file.line[n] = kind == "string" and '""' or word, line
      if kind == "sign" and OPEN[word] then open[#open + 1] = n end
      if kind == "sign" and word:find "^[%)%]}]$" then
        local opened = assert(table.remove(open), file.path .. ": brackets do not match")
        assert(OPEN[file.text[opened]] == word, file.path .. ": brackets do not match")
        file.close[opened] = n
      end
    end
    is_first = kind == "blank" and (is_first or word:find "\n" ~= nil)
    line = line + select(2, word:gsub("\n", ""))
    at = last + 1
  end
  assert(#open == 0, file.path .. ": brackets do not match")
end

return c_tokens
