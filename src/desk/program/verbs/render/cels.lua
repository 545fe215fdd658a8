--- Refuses --cel NAME if no frame of the film has a cel of this name. The frames that are rendered
--- are searched first, then the rest of the film.
local program, request, script, numbers = ...

local FRAMES_MOST = 10000 -- frames that are looked through
local NAMES_MOST = 12 -- in the message

local wanted, names, known = request.cel, {}, {}

--- Whether the search is over. The failure of a frame is reported when it is made.
local function is_found(number)
  if program.is_stopped() or not script:try(number) then return true end
  for _, name in ipairs(script:cels()) do
    if name == wanted then return true end
    if not known[name] then
      names[#names + 1], known[name] = name, program.distance(wanted, name)
    end
  end
end

for _, number in ipairs(numbers) do
  if is_found(number) then return end
end
for i = 0, math.min(script.frames, FRAMES_MOST) - 1 do
  if is_found(script.first + i) then return end
end
if #names == 0 then
  program.usage("--cel %s: no cel of the film has a name; give it one with cel:named(\"%s\")",
    wanted, wanted)
end
table.sort(names, function(a, b)
  if known[a] ~= known[b] then return known[a] < known[b] end
  return a < b
end)
program.usage("--cel %s: no cel of the film has this name; its names are %s%s", wanted,
  table.concat(names, ", ", 1, math.min(#names, NAMES_MOST)),
  #names > NAMES_MOST and " and others" or "")
