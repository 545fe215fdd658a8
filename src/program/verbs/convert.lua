--- celspan convert IN OUT: any picture to any other.
local program, request = ...

program.refuse_target(request[2])
program.convert(request[1], request[2])
