--- celspan spans SCRIPT|FILE: the spans of one frame as text, or with --stats their counts.
local program, request = ...

for _, name in ipairs { "pixels", "json" } do
  if request[name] and not request.stats then program.usage("--%s needs --stats", name) end
end
local is_plane = program.kind(request[1]) == "plane"
if is_plane and request.stats then
  program.usage("--stats: %s is a plane, of which 'celspan info' gives figures", request[1])
end
local shown = program.shown(request[1], not is_plane)
local first, last = (request.rows or ""):match "(%d+)%D+(%d+)"
if last and last + 0 >= shown.height then
  program.usage("--rows %d-%d: the frame has rows 0 to %d", first, last, shown.height - 1)
end
if not request.stats then return shown:print_spans(first, last) end
local counts, seconds = shown:measure(first, last)
local parts = {}
for i, name in ipairs(counts) do
  parts[i] = (request.json and '"%s": %d, ' or "%s %d "):format(name, counts[name])
end
local line = table.concat(parts)
if request.json then return print(('{%s"seconds": %.6f}'):format(line, seconds)) end
print(("%sseconds %.6f"):format(line, seconds))
-- what was kept and what was made
print(("cels: %d drawn from kept maps, %d from new maps, %d swept; rows: %d made, %d taken from "
  .. "held bands; rows of blurs: %d made, %d found again, %.1f MiB kept"):format(
  counts.maps - counts.maps_made, counts.maps_made, counts.swept, counts.rows - counts.rows_held,
  counts.rows_held, counts.bands_made, counts.bands_found, counts.bands_bytes / 1048576))
