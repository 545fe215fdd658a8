-- Rows of spans, as celspan.spans returns them: reading colours, checking, writing as text.
local rows = {}

local function span_at(row, x)
  local low, high = 1, #row
  while low < high do
    local middle = (low + high) // 2
    if row[middle].x1 > x then high = middle else low = middle + 1 end
  end
  return row[low]
end

--- The colour of column x: {r, g, b, a}; and the kind of its span.
function rows.colour(row, x)
  local span = span_at(row, x)
  local colour, last = {}, span.x1 - 1 - span.x0
  for c = 1, 4 do
    if span.kind == "single" then
      colour[c] = span[c]
    elseif span.kind == "array" then
      colour[c] = span[4 * (x - span.x0) + c]
    else
      local u = last > 0 and (x - span.x0) / last or 0
      colour[c] = span[c] + (span[4 + c] - span[c]) * u
    end
  end
  return colour, span.kind
end

--- What is wrong in the order of a row of `width` columns, or nil.
function rows.fault(row, width)
  local at = 0
  for i, span in ipairs(row) do
    if span.x0 ~= at then return ("span %d begins at %d, not at %d"):format(i, span.x0, at) end
    if span.x1 <= span.x0 then return ("span %d is empty"):format(i) end
    at = span.x1
    for k = 1, #span do
      if span[k] ~= span[k] then return ("span %d contains a NaN"):format(i) end
    end
    local before = row[i - 1]
    if before and before.kind == "single" and span.kind == "single" and before[1] == span[1]
      and before[2] == span[2] and before[3] == span[3] and before[4] == span[4] then
      return ("spans %d and %d are one"):format(i - 1, i)
    end
  end
  if at ~= width then return ("the row ends at %d of %d"):format(at, width) end
end

--- Rows first..last as text. format: for numbers, by default "%a" (to the bit).
function rows.text(list, first, last, format)
  local lines = {}
  for y = first, last do
    for _, span in ipairs(list[y]) do
      local words = { y, span.x0, span.x1, span.kind }
      for i = 1, #span do words[#words + 1] = (format or "%a"):format(span[i]) end
      lines[#lines + 1] = table.concat(words, " ")
    end
  end
  return table.concat(lines, "\n")
end

return rows
