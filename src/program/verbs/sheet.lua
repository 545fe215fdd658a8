--- celspan sheet FILE|SCRIPT: an exposure sheet as text or converted, or the sheet of a film.
local program, request = ...
local sheet = require "celspan.sheet"

local input, output = request[1], request.output
local is_script = program.has_ending(input, ".lua")

if output and output ~= "-" and not program.has_ending(output, ".xdts", ".csv", ".txt") then
  program.usage("-o: '%s' must end in .xdts, .csv or .txt", output)
end
if request.frames and not is_script then
  program.usage("--frames goes with a script, and %s is a sheet", input)
end
if not is_script then program.refuse_rights() end

local film = is_script and program.film()
local made = film and sheet.of(film, request.frames and { frames = film:numbers() })
  or program.input(sheet.read(input))
if output and program.has_ending(output, ".csv") and not made.width then
  program.note("%s has no size: %s says 1920 x 1080", input, output)
end
program.put(made, output, input)
