--- Cycles of a graph: its strongly connected components with more than one node.
local circles = {}

--- edges[from][to] = true; returns lists of names, each sorted, in the order of their first names.
function circles.find(edges)
  local index, low, stack, on_stack, count = {}, {}, {}, {}, 0
  local found = {}

  local function close(node)
    local list = {}
    repeat
      local other = table.remove(stack)
      on_stack[other] = nil
      list[#list + 1] = other
    until other == node
    table.sort(list)
    if #list > 1 then found[#found + 1] = list end
  end

  local function visit(node)
    count = count + 1
    index[node], low[node] = count, count
    stack[#stack + 1], on_stack[node] = node, true
    for other in pairs(edges[node] or {}) do
      if not index[other] then
        visit(other)
        low[node] = math.min(low[node], low[other])
      elseif on_stack[other] then
        low[node] = math.min(low[node], index[other])
      end
    end
    if low[node] == index[node] then close(node) end
  end

  for node in pairs(edges) do
    if not index[node] then visit(node) end
  end
  table.sort(found, function(a, b) return a[1] < b[1] end)
  return found
end

return circles
