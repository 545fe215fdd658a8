--- celspan play SCRIPT: the page of celspan watch with the picture alone, opened in the browser.
local program, request = ...

request.open, request.is_alone = true, true
return program.part("watch.lua", program, request)
