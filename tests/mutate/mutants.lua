-- Makes the mutants of a C source: one small change each, similar to a programmer's mistake.
--
-- A mutant is { from, to (bytes of the source that are replaced), before, after (texts), line,
-- column, kind, nth (among those of its line that are printed alike, from 1) }. It has as many
-- lines as the source.
local code = require "tests.mutate.code"
local tokens = require "tests.mutate.tokens"

local mutants = {}

--- Replacements of marks; those of `binary` only between two operands.
local marks = {
  ["<"] = { bound = "<=", comparison = ">" },
  ["<="] = { bound = "<", comparison = ">=" },
  [">"] = { bound = ">=", comparison = "<" },
  [">="] = { bound = ">", comparison = "<=" },
  ["=="] = { comparison = "!=" },
  ["!="] = { comparison = "==" },
  ["&&"] = { operator = "||" },
  ["||"] = { operator = "&&" },
  ["/"] = { operator = "*" },
  ["%"] = { operator = "*" },
  ["<<"] = { operator = ">>" },
  [">>"] = { operator = "<<" },
  ["|"] = { operator = "&" },
  ["^"] = { operator = "|" },
  ["+="] = { operator = "-=" },
  ["-="] = { operator = "+=" },
  ["*="] = { operator = "/=" },
  ["/="] = { operator = "*=" },
  ["|="] = { operator = "&=" },
  ["&="] = { operator = "|=" },
  ["++"] = { operator = "--" },
  ["--"] = { operator = "++" },
  ["!"] = { condition = "" },
}
local binary = {
  ["+"] = { operator = "-" },
  ["-"] = { operator = "+" },
  ["*"] = { operator = "/" },
  ["&"] = { operator = "|" },
}
local words = { ["true"] = { constant = "false" }, ["false"] = { constant = "true" } }

-- Their arguments may be swapped without a change.
local symmetric = { fmin = true, fmax = true, fminf = true, fmaxf = true, hypot = true,
  cs_mem_array = true }

--- Replacements of a number: one more or less for an integer, twice a fraction.
local function numbers(text)
  local digits, ending = text:match "^(%d+)([uUlL]*)$"
  if digits then
    local value = math.tointeger(tonumber(digits))
    if not value then return {} end
    local list = { constant = ("%d%s"):format(value + 1, ending) }
    if value > 0 then list.bound = ("%d%s"):format(value - 1, ending) end
    return list
  end
  local hexadecimal, unsigned = text:match "^0[xX](%x+)([uUlL]*)$"
  if hexadecimal then
    return { constant = ("0x%x%s"):format(tonumber(hexadecimal, 16) + 1, unsigned) }
  end
  local fraction, suffix = text:match "^([%d.eE+-]+)([fF]?)$"
  local value = tonumber(fraction)
  if not value then return {} end
  if value == 0 then return { constant = "1.0" .. suffix } end
  return { constant = ("%.17g"):format(2 * value):gsub("^%d+$", "%0.0") .. suffix }
end

--- Replacements of a token: a table from kind of mutant to text.
local function changes(list, i)
  local token = list[i]
  if token.kind == "number" then return numbers(token.text) end
  if token.kind == "word" then return words[token.text] or {} end
  if marks[token.text] then return marks[token.text] end
  if binary[token.text] and code.is_binary(list, i) then return binary[token.text] end
  return token.text == "-" and { operator = "" } or {}
end

--- The first and last index of each argument between the brackets at i and j.
local function arguments(list, i, j)
  local found, from, k = {}, i + 1, i + 1
  while k <= j do
    if list[k].text == "," or k == j then
      if k > from then found[#found + 1] = { from, k - 1 } end
      from = k + 1
    end
    k = (k < j and list[k].pair and list[k].pair > k and list[k].pair or k) + 1
  end
  return found
end

local KINDS = { "bound", "comparison", "operator", "condition", "constant" }

--- Returns a maker of the mutants of `text`, which calls `add` with each.
local function maker(text, list, add)
  local function between(i, j) return text:sub(list[i].from, list[j].to) end

  local function replace(kind, i, j, after)
    local before = between(i, j)
    local _, lines = before:gsub("\n", "")
    local _, now = after:gsub("\n", "")
    add { kind = kind, from = list[i].from, to = list[j].to, before = before,
      after = after .. ("\n"):rep(lines - now) }
  end

  local function swap(i)
    local found = arguments(list, i, list[i].pair)
    for k = 1, #found - 1 do
      local a, b = found[k], found[k + 1]
      local first, second = between(a[1], a[2]), between(b[1], b[2])
      if first ~= second then
        replace("swap", a[1], b[2], second .. between(a[2] + 1, b[1] - 1) .. " " .. first)
      end
    end
  end

  --- Whether the comparison at i selects between its operands, as `a < b ? a : b` does: then its
  --- result for equal ones does not matter.
  local function chooses(i)
    local stop = i + 1
    while list[stop] and not list[stop].text:find "^[]?;,)}]$" do
      stop = (list[stop].pair or stop) + 1
    end
    if not list[stop] or list[stop].text ~= "?" then return false end
    local right = between(i + 1, stop - 1)
    local function left_is(from, to)
      local length = to - from
      return i - 1 - length > 0 and between(i - 1 - length, i - 1) == between(from, to)
    end
    local colon = stop + 1
    while list[colon].text ~= ":" do colon = (list[colon].pair or colon) + 1 end
    local first = between(stop + 1, colon - 1)
    if left_is(stop + 1, colon - 1) then
      return text:sub(list[colon + 1].from, list[colon + 1].from + #right - 1) == right
    end
    if first ~= right then return false end
    local last = colon + 1
    while not list[last].text:find "^[];,)}]$" do last = (list[last].pair or last) + 1 end
    return left_is(colon + 1, last - 1)
  end

  local function is_call(i)
    local name = list[i - 1]
    return list[i].text == "(" and name.kind == "word" and not code.keywords[name.text]
      and not symmetric[name.text]
  end

  local see = {}

  function see.expression(first, last)
    local i = first
    while i <= last do
      if list[i].text == "sizeof" or list[i].text == "CS_SELF_CHECK" then
        i = list[i + 1].pair or i
      else
        local to = changes(list, i)
        for _, kind in ipairs(KINDS) do
          if to[kind] and not (kind == "bound" and list[i].kind == "mark" and chooses(i)) then
            replace(kind, i, i, to[kind])
          end
        end
        if is_call(i) then swap(i) end
      end
      i = i + 1
    end
  end

  function see.condition(i, j) replace("condition", i, j, "!(" .. between(i, j) .. ")") end

  function see.statement(i, j) replace("statement", i, j, ";") end

  return see
end

--- All mutants of a source, in its order.
function mutants.of(text)
  local list, found = tokens.read(text), {}
  code.walk(list, maker(text, list, function(mutant) found[#found + 1] = mutant end))
  local line, at, told = 1, 1, {}
  table.sort(found, function(a, b)
    if a.from ~= b.from then return a.from < b.from end
    if a.to ~= b.to then return a.to < b.to end
    return a.kind < b.kind or a.kind == b.kind and a.after < b.after
  end)
  for _, mutant in ipairs(found) do
    for _ in text:sub(at, mutant.from - 1):gmatch "\n" do line = line + 1 end
    at, mutant.line = mutant.from, line
    mutant.column = mutant.from - (text:sub(1, mutant.from - 1):match ".*()\n" or 0)
    local name = line .. mutants.tell(mutant)
    told[name] = (told[name] or 0) + 1
    mutant.nth = told[name]
  end
  return found
end

--- The source with the mutant in it.
function mutants.apply(text, mutant)
  return text:sub(1, mutant.from - 1) .. mutant.after .. text:sub(mutant.to + 1)
end

--- The source line of a mutant, without the space around it.
function mutants.line_of(text, mutant)
  return text:sub(mutant.from - mutant.column + 1):match "^%s*([^\n]-)%s*%f[\n\0]"
end

--- The change of a mutant, in one line.
function mutants.tell(mutant)
  local function flat(part)
    part = part:gsub("%s+", " "):gsub("^ ", ""):gsub(" $", "")
    return part == "" and "nothing" or part
  end
  if mutant.kind == "statement" then return ("drop `%s`"):format(flat(mutant.before)) end
  return ("`%s` to `%s`"):format(flat(mutant.before), flat(mutant.after))
end

return mutants
