--- The commands of SVG path data.
local pathdata = {}

--- The number of arguments of each command.
local counts = { M = 2, L = 2, H = 1, V = 1, C = 6, S = 4, Q = 4, T = 2, A = 7, Z = 0 }

local number_pattern = "^[%s,]*([+-]?%d*%.?%d*[eE]?[+-]?%d*)"

--- One number at `at`; flags of arcs are single digits that may touch.
local function read_number(text, at, is_flag)
  if is_flag then
    local flag, after = text:match("^[%s,]*([01])()", at)
    return tonumber(flag), after
  end
  local digits = text:match(number_pattern, at)
  -- an e without an exponent, or a second sign, ends the number
  while digits and digits ~= "" and not tonumber(digits) do digits = digits:sub(1, -2) end
  if not digits or digits == "" then return nil end
  local _, stop = text:find("^[%s,]*", at)
  return tonumber(digits), stop + 1 + #digits
end

--- The commands of path data in order, each { command = "l", x, y }, with the letter and the
--- numbers that are written; an omitted letter is filled in. Or nil and a message.
---@param text string
---@return table[]? commands
---@return string? message
function pathdata.commands(text)
  local commands, at, letter = {}, 1, nil
  while true do
    at = text:find("[^%s,]", at)
    if not at then return commands end
    local found = text:match("^[A-Za-z]", at)
    if found then letter, at = found, at + 1 end
    local upper = letter and letter:upper()
    local count = upper and counts[upper]
    if not count or (count == 0 and not found) or (#commands == 0 and upper ~= "M") then
      return nil, ("path data has something unknown at byte %d"):format(at)
    end
    local n = { command = letter }
    for i = 1, count do
      n[i], at = read_number(text, at, upper == "A" and (i == 4 or i == 5))
      if not n[i] then return nil, ("path data lacks a number after '%s'"):format(letter) end
    end
    commands[#commands + 1] = n
    if upper == "M" then letter = letter == "M" and "L" or "l" end
  end
end

return pathdata
