--- Lists whose items ascend.
local ordered = {}

--- The index of the last item whose value is at most `most`; 0 if there is none. field: the name of
--- the field with this value; the list is sorted by it. Without `field`, the items are numbers.
function ordered.last(list, most, field)
  local low, high = 0, #list
  while low < high do
    local middle = (low + high + 1) // 2
    local item = list[middle]
    if (field and item[field] or item) <= most then low = middle else high = middle - 1 end
  end
  return low
end

--- The names of a table, which are strings, in the order of their bytes.
---@param named table<string, any>
---@return string[]
function ordered.names(named)
  local names = {}
  for name in pairs(named) do names[#names + 1] = name end
  table.sort(names)
  return names
end

return ordered
