--- Sets of parts: of "mouth A", "mouth B" and "mouth C" only one is shown.
--
-- "mouth C", "mouth-C" and "mouth/C" are the C of the set "mouth".
local core = require "celspan.core"
local fields = require "celspan.fields"

local sets = {}

--- The members of a set: the names of the parts by member. A sorted list of the members too.
---@param parts table<string, any> By name
---@param set string
function sets.members(parts, set)
  local members, names = {}, {}
  for name in pairs(parts) do
    local member = name:sub(1, #set) == set and name:sub(#set + 1):match "^[ %-_/.:]+(.+)$"
    if member then
      if not members[member] then
        members[member] = {}
        names[#names + 1] = member
      end
      table.insert(members[member], name)
    end
  end
  table.sort(names)
  return members, names
end

--- Checks that a set has this member; false shows no member. Returns the members of the set.
local function check(noun, whole, parts, set, choice)
  if type(set) ~= "string" or type(choice) ~= "string" and choice ~= false then
    core.refuse(("%s takes a name for each set, such as { mouth = \"C\" }, got %s = %s"):format(
      noun, tostring(set), type(choice) == "string" and choice or fields.kind(choice)))
  end
  local members, names = sets.members(parts, set)
  if #names == 0 then
    core.refuse(("%s: %s has no parts named '%s A', '%s B' and so on"):format(noun, whole, set,
      set))
  end
  if choice and not members[choice] then
    local hint = core.nearest(choice, names)
    core.refuse(("%s: the parts of '%s' are %s, and not '%s'%s"):format(noun, set,
      table.concat(names, ", "), choice, hint and ("; did you mean '%s'?"):format(hint) or ""))
  end
  return members
end

--- The names of the parts that are not shown.
---@param noun string For messages: "svg: show"
---@param whole string "the drawing"
---@param parts table<string, any> By name
---@param choices table<string, string|false> The member of each set that is shown
---@return string[] hidden
function sets.hidden(noun, whole, parts, choices)
  local hidden = {}
  for set, choice in next, choices do
    for member, names in next, check(noun, whole, parts, set, choice) do
      if member ~= choice then table.move(names, 1, #names, #hidden + 1, hidden) end
    end
  end
  return hidden
end

return fields.seal("sets", sets)
