--- A table as a list of { name =, tint =, list = { { year, tons }, ... } }.
local csv = require "celspan.csv"
local tints = { "#f0503c", "#f7a325", "#3cae7e", "#4a63d8", "#9a5fc9", "#d9588f" }

return function(file)
  local tracks, by_name = {}, {}
  for _, row in ipairs(assert(csv.read(file, { types = { year = "number",
      tons = "number" } }))) do
    local track = by_name[row.fruit]
    if not track then
      track = { name = row.fruit, tint = tints[#tracks % #tints + 1], list = {} }
      by_name[row.fruit] = track
      tracks[#tracks + 1] = track
    end
    table.insert(track.list, { row.year, row.tons })
  end
  return tracks
end
