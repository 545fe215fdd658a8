--- How requests for the page are answered (celspan watch).
local program, web = ...

local reply = {}

local POLICY = "default-src 'self'; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"

function reply.send(id, status, kind, bytes, ...)
  web:answer(id, status, {
    "Content-Type", kind, "Content-Security-Policy", POLICY, "X-Content-Type-Options", "nosniff",
    "Cross-Origin-Resource-Policy", "same-origin", "Cross-Origin-Opener-Policy", "same-origin",
    "Referrer-Policy", "no-referrer", "Cache-Control", "no-store", ... }, bytes)
end

function reply.refuse(id, status, sentence)
  reply.send(id, status, "text/plain; charset=utf-8", sentence .. "\n")
end

--- Calls a function that answers a request. An error in it ends only that request.
function reply.attempt(id, call, ...)
  local is_good, fault = pcall(call, ...)
  if not is_good then reply.refuse(id, 500, "the answer could not be made: " .. tostring(fault)) end
end

function reply.json(id, value, status)
  reply.send(id, status or 200, "application/json", program.json(value) .. "\n")
end

--- Asks the renderers, and sends their answer.
function reply.ask(id, side, ask, give, wish)
  side:ask(ask, function(...) reply.attempt(id, give, ...) end,
    function(status, message) reply.refuse(id, status, message) end, wish)
end

return reply
