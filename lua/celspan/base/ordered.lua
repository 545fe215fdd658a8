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

--- Sorts a list by a field of its items; those with the same value keep their order. Returns it.
function ordered.sort(list, field)
  local place, is_sorted = {}, true
  for i, item in ipairs(list) do
    place[item] = i
    is_sorted = is_sorted and (i == 1 or list[i - 1][field] <= item[field])
  end
  if is_sorted then return list end
  table.sort(list, function(a, b)
    if a[field] ~= b[field] then return a[field] < b[field] end
    return place[a] < place[b]
  end)
  return list
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
