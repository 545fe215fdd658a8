--- celspan convert IN OUT: converts a picture to another format, or a drawing or a layered painting
--- to a picture.
local program, request = ...

if program.has_number(request[2]) then
  program.usage("%s: one picture is written, so its name has no place for a number", request[2])
end
program.refuse_target(request[2])
if program.kind(request[1]) == "plane" then program.refuse_self(request[1], request[2]) end
program.convert(request[1], request[2])
