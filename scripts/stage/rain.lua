--- A table with a column for each tenth year, as keys by the name of the region.
local csv = require "celspan.csv"

return function(file)
  local rain = {}
  for _, row in ipairs(assert(csv.read(file))) do
    local list = {}
    for year = 1990, 2020, 10 do
      list[#list + 1] = { year, tonumber(row[tostring(year)]) }
    end
    rain[row.region] = keys(list)
  end
  return rain
end
