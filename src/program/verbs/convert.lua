--- celspan convert IN OUT: any picture to any other; a drawing or a layered painting to a picture.
local program, request = ...

program.refuse_target(request[2])
local kind = program.kind(request[1])
if kind == "svg" or kind == "archive" then
  local film = program.film()
  program.write(film:at(film.first), request[2], table.unpack(film.size))
else
  program.convert(request[1], request[2])
end
