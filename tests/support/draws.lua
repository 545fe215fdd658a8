-- Checks that no test depends on the order in which a compiler evaluates arguments, initialisers or
-- operands: C leaves it open, so with two random numbers among them other compilers would test
-- other cases.
--
--   lua5.4 tests/support/draws.lua [ROOT]
--
--   circle(random_unit(&r), random_unit(&r))          refused
--   double x = random_unit(&r), y = random_unit(&r)   one after the other, with every compiler
--
-- A draw is a call of random_...(), or of a function of the same file that calls one.
package.path = "./?.lua;" .. package.path
local c_source = require "tests.support.rooms.c_source"

local root = arg[1] or "."

--- Separators of operands whose order C defines.
local ORDERED = { [","] = true, [";"] = true, ["&&"] = true, ["||"] = true, ["?"] = true,
  [":"] = true }
local CONTROL = { ["if"] = true, ["for"] = true, ["while"] = true, ["switch"] = true }

--- Returns a function that reports whether a draw is called at a token.
local function draw_finder(file)
  local known, is_growing = {}, true
  local function is_draw(i)
    local word = file.text[i]
    return file.text[i + 1] == "(" and (known[word] or word:find "^random_%a" ~= nil)
  end
  while is_growing do
    is_growing = false
    for _, fn in ipairs(file.functions) do
      for i = fn.from, known[fn.name] and 0 or fn.to do
        if is_draw(i) then known[fn.name], is_growing = true, true end
      end
    end
  end
  return is_draw
end

--- Whether the braces at a token contain statements, not initialisers.
local function is_block(file, open)
  local i = open + 1
  while i < file.close[open] do
    if file.text[i] == ";" then return true end
    i = (file.close[i] or i) + 1
  end
  return i == open + 1
end

--- How many items of a list contain a draw, and the first token of the last such item.
local function count_items(file, open, draws)
  local count, i, has_draw = 0, open + 1, false
  while i <= file.close[open] do
    if file.text[i] == "," or i == file.close[open] then
      count, has_draw = count + (has_draw and 1 or 0), false
    end
    local last = file.close[i] or i
    if i < file.close[open] then has_draw = has_draw or draws.are_in(i, last) end
    i = last + 1
  end
  return count
end

--- Calls `fault` for operands of one expression inside a bracket, if two or more contain a draw.
local function check_operands(file, open, draws, fault)
  local count, i = 0, open + 1
  while i < file.close[open] do
    local last = file.close[i] or i
    local draw = draws.are_in(i, last)
    local is_apart = last > i
      and (CONTROL[file.text[i - 1]] or file.text[i] == "{" and is_block(file, i))
    if ORDERED[file.text[i]] or is_apart then
      count = 0
    elseif draw and not (last > i and draws[i - 1]) then -- a draw counts with its arguments
      count = count + 1
      if count == 2 then fault(i) end
    end
    i = last + 1
  end
end

--- For each token, whether a draw is called there; and draws.are_in(from, to), whether any is
--- called in a range.
local function list_draws(file)
  local is_draw, draws, before = draw_finder(file), {}, { 0 }
  for i = 1, #file.text do
    draws[i] = is_draw(i)
    before[i + 1] = before[i] + (draws[i] and 1 or 0)
  end
  function draws.are_in(from, to) return before[to + 1] > before[from] end
  return draws
end

local function check_file(path, fault)
  local file = c_source.read(path)
  local draws = list_draws(file)
  local function found(i) fault("%s:%d: two draws in an undefined order", path, file.line[i]) end
  for open in pairs(file.close) do
    local is_list = file.text[open] == "(" and not CONTROL[file.text[open - 1]]
      or file.text[open] == "{" and not is_block(file, open)
    if is_list and count_items(file, open, draws) > 1 then found(open) end
    check_operands(file, open, draws, found)
  end
end

local faults = {}
local files = assert(io.popen(("cd '%s' && find tests subprojects/*/tests -name '*.[ch]' | sort")
  :format(root)))
local count = 0
for path in files:lines() do
  count = count + 1
  local is_good = true
  check_file(root .. "/" .. path, function(...)
    -- one fault for each file, because each file counts as one check
    if is_good then faults[#faults + 1] = string.format(...) end
    is_good = false
  end)
end
files:close()
table.sort(faults)
for _, text in ipairs(faults) do io.stderr:write(text, "\n") end
if #faults > 0 then
  print(("%d of %d checks failed"):format(#faults, count))
  os.exit(1)
end
print(("%d checks passed"):format(count))
