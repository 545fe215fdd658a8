--- celspan track PATTERN: follows a region through frames.
local program, request = ...
local track = require "celspan.track"

if not request.from or not request.at then
  program.usage("track needs --from N and --at X,Y,W,H: the frame in which the region is given, "
    .. "and the region there")
end
local followed = program.input(track.follow(request[1], {
  from = tonumber(request.from), at = program.numbers(request.at), frames = request.frames,
  model = request.model }))
local lost = table.concat(followed.lost, ", ")
program.note("%d frames followed, %d lost%s%s", #followed.frames, #followed.lost,
  lost == "" and "" or ": ", lost)
program.put(followed, request.output, request[1])
