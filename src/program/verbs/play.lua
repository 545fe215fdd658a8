--- celspan play SCRIPT: the page of celspan watch with the picture alone, opened in the browser.
local program, request = ...

request.open, request.is_alone = true, true
return assert(load(program.text "watch.lua", "=watch.lua", "t"))(program, request)
