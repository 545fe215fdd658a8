--- Sets of parts: of "mouth A", "mouth B" and "mouth C" only one is shown.
--
-- "mouth C", "mouth-C" and "mouth/C" are the C of the set "mouth". "mouth/C" is also the child "C"
-- of a group that is named "mouth", and so is its child "mouth C".
local native = require "celspan.native"
local fields = require "celspan.fields"
local ordered = require "celspan.ordered"

local sets = {}

local PARTED = "^[ %-_/.:]+([^/]+)$" -- the rest of a name after the name of its set

--- The member of a set that a name means; nil: none. Names inside a member are not members.
local function member_of(name, set)
  local rest = name:sub(1, #set) == set and name:sub(#set + 1):match(PARTED)
  return rest and (member_of(rest, set) or rest) or nil
end

--- The elements of a drawing that are children of a part, as { name = "mouth/C", element = }. Their
--- names are their labels; if no child of a part has a label, their ids.
---@param elements celspan.svg.element[]
---@param parts table<string, any> By name
function sets.children(elements, parts)
  local open, list = {}, {}
  local function close(group)
    for _, name in ipairs { group.element.id or false, group.element.label or false } do
      for _, child in ipairs(name and rawget(parts, name) and group or {}) do
        local own = child[group.named_by]
        if own then list[#list + 1] = { name = name .. "/" .. own, element = child } end
      end
    end
  end
  for _, element in ipairs(elements) do
    for depth = #open, element.depth + 1, -1 do close(table.remove(open, depth)) end
    local parent = open[element.depth]
    if parent then
      parent[#parent + 1] = element
      if element.label then parent.named_by = "label" end
    end
    open[element.depth + 1] = { element = element, named_by = "id" }
  end
  for depth = #open, 1, -1 do close(open[depth]) end
  return list
end

--- "; did you mean 'mouth'?" for a set that does not exist; "" if no set has a similar name.
---@param parts table<string, any> By name
---@param set string
function sets.hint(parts, set)
  local known = {}
  for name in pairs(parts) do
    for place in name:gmatch "()[ %-_/.:]" do known[name:sub(1, place - 1)] = true end
  end
  return fields.hint(set, ordered.names(known)) or ""
end

--- The members of a set: the names of the parts, by member. Also a sorted list of the members.
---@param parts table<string, any> By name
---@param set string
function sets.members(parts, set)
  local members, names = {}, {}
  for name in pairs(parts) do
    local member = member_of(name, set)
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
    native.refuse(("%s takes a name for each set, such as { mouth = \"C\" }, got %s = %s"):format(
      noun, fields.key(set), type(choice) == "string" and choice or fields.kind(choice)))
  end
  local members, names = sets.members(parts, set)
  if #names == 0 then
    native.refuse(("%s: %s has no parts named '%s A', '%s B' and so on%s"):format(noun, whole, set,
      set, sets.hint(parts, set)))
  end
  if choice and not members[choice] then
    native.refuse(("%s: the parts of '%s' are %s, and not '%s'%s"):format(noun, set,
      table.concat(names, ", "), choice, fields.hint(choice, names) or ""))
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
