--- The prose of a file: its comments and string literals, or a page without its code.
---
--- The result has the length of the file, so positions agree. Code is replaced by BARRIER; what
--- only separates words of one sentence (comment signs, quotation marks, indentation) by blanks.
local prose_text = {}

local BARRIER = "\0"

local function blank(text) return (text:gsub("[^\n]", " ")) end

local function barrier(text) return (text:gsub("%S", BARRIER)) end

--- A comment: `sign` matches the beginning of each of its lines after the first.
local function comment(text, first, sign)
  text = text:gsub("^" .. first, blank)
  if sign then text = text:gsub("\n[ \t]*" .. sign, blank) end
  return text
end

--- A string literal that begins at `at`: its end, which is the end of its line at the latest.
local function string_end(text, at, quote)
  local last = at
  repeat
    last = text:find("[\\\n" .. quote .. "]", last + 1)
    if not last then return #text end
    local sign = text:sub(last, last)
    if sign == "\\" then last = last + 1 end
  until sign ~= "\\"
  return last
end

--- A string literal; a literal without blanks is a name, not a message.
local function literal(text)
  if not text:find "%s" then return barrier(text) end
  return " " .. text:sub(2, -2):gsub("\\.", "  ") .. (#text > 1 and " " or "")
end

-- ---------------------------------------------------------------- languages

-- A language cuts the text at `at`. It returns the end of the piece and its prose, or nothing where
-- code begins.

local function cut_quoted(text, at, quotes)
  local sign = text:sub(at, at)
  if not quotes:find(sign, 1, true) then return end
  local last = string_end(text, at, sign)
  return last, literal(text:sub(at, last))
end

local function cut_c(text, at)
  local two = text:sub(at, at + 1)
  if two == "//" then
    local last = (text:find("\n", at, true) or #text + 1) - 1
    return last, comment(text:sub(at, last), "//+")
  elseif two == "/*" then
    local last = select(2, text:find("*/", at + 2, true)) or #text
    return last, comment(text:sub(at, last - 2), "/%*+", "%*") .. "  "
  end
  return cut_quoted(text, at, "\"'")
end

--- The end of a long bracket that begins at `at`, and the length of its sign.
local function long_bracket(text, at)
  local level = text:match("^%[(=*)%[", at)
  if not level then return end
  return select(2, text:find("]" .. level .. "]", at, true)) or #text, #level + 2
end

local function cut_lua(text, at)
  if text:sub(at, at + 1) == "--" then
    local last, width = long_bracket(text, at + 2)
    if last then
      return last, blank(text:sub(at, at + width + 1)) .. text:sub(at + width + 2, last)
    end
    last = (text:find("\n", at, true) or #text + 1) - 1
    return last, comment(text:sub(at, last), "%-+")
  end
  local last, width = long_bracket(text, at)
  if last then
    local inner = text:sub(at + width, last - width):gsub("%-%-", "  ")
    return last, (" "):rep(width) .. inner .. (" "):rep(last - at + 1 - width - #inner)
  end
  if text:find("^%.%.%f[^.]", at) then return at + 1, "  " end
  return cut_quoted(text, at, "\"'")
end

local function cut_shell(text, at)
  local sign = text:sub(at, at)
  if sign == "#" and (at == 1 or text:find("^%s", at - 1)) then
    local last = (text:find("\n", at, true) or #text + 1) - 1
    return last, comment(text:sub(at, last), "#+!?")
  end
  local name = text:match("^<<'?(%u+)'?", at)
  if name then
    local last = select(2, text:find("\n" .. name .. "\n", at, true)) or #text
    return last, text:sub(at, last)
  end
  if sign ~= '"' and sign ~= "'" then return end
  local last = text:find(sign, at + 1, true) or #text
  return last, literal(text:sub(at, last))
end

local function prose_of_code(text, cut)
  local parts, at, code = {}, 1, 1
  while at <= #text do
    local last, prose = cut(text, at)
    if last then
      parts[#parts + 1] = barrier(text:sub(code, at - 1))
      parts[#parts + 1] = prose
      code = last + 1
    end
    at = (last or at) + 1
    at = text:find("[-/\"'#<%[.]", at) or #text + 1
  end
  parts[#parts + 1] = barrier(text:sub(code))
  return table.concat(parts)
end

local CUTS = { c = cut_c, h = cut_c, cpp = cut_c, js = cut_c, lua = cut_lua, sh = cut_shell,
               run = cut_shell, build = cut_shell, txt = cut_shell }

--- A page: only the comments and literals of its code blocks count.
local function prose_of_page(text)
  text = ("\n" .. text):gsub("(\n```(%w*)[^\n]*)(.-\n)(```)", function(open, language, block, close)
    local cut = CUTS[language]
    return barrier(open) .. (cut and prose_of_code(block, cut) or block) .. barrier(close)
  end):sub(2)
  text = text:gsub("%]%([^)\n]*%)", barrier)
  return (text:gsub("\n[ \t]*>", blank))
end

--- The prose of the text of a file with that path; nil for an unknown kind of file.
function prose_text.of(text, path)
  local kind = path:match "[^./]+$"
  local prose
  if kind == "md" then
    prose = prose_of_page(text)
  elseif CUTS[kind] then
    prose = prose_of_code(text, CUTS[kind])
  else
    return
  end
  prose = prose:gsub("`[^`]*`", function(code)
    if #code < 200 and not code:find "\n[ \t]*\n" then return barrier(code) end
  end)
  prose = prose:gsub("\n([ \t]*)%f[\n]", function(blanks)
    return BARRIER .. blanks
  end)
  assert(#prose == #text, path)
  return prose
end

return prose_text
