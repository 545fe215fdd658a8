--- Who may ask the page's server what (celspan watch).
--
--   Host      127.0.0.1, localhost or [::1] with our port: other names are a stranger's, which
--             point here (DNS rebinding)
--   Origin    where one is sent, ours
--   token     in the query, for programs; or in a header, from our own page. It is in no cookie:
--             those go to the servers of all ports of a machine
--
-- What is the same for every film, such as the texts of the page, needs no token, unless another
-- site leads there. The page is loaded again by itself then, without what follows the # of the
-- address: values of parameters that the site would have chosen.
--
-- INVARIANT: a request that passes has a path of plain characters without "..", and its texts are
-- decoded once.
local guard = {}
guard.__index = guard

--- public: the paths that need no token, as keys.
function guard.new(port, public, token)
  local self = setmetatable({ token = token, public = public, hosts = {}, origins = {} },
    guard)
  for _, name in ipairs { "127.0.0.1", "localhost", "[::1]" } do
    local host = ("%s:%d"):format(name, port)
    self.hosts[host], self.origins["http://" .. host] = true, true
  end
  return self
end

--- Whether a text is the token. The time that this takes does not depend on the first difference.
function guard:is_token(text)
  if type(text) ~= "string" or #text ~= #self.token then return false end
  local differs = 0
  for i = 1, #text do differs = differs | (text:byte(i) ~ self.token:byte(i)) end
  return differs == 0
end

local function decode(text)
  return (text:gsub("+", " "):gsub("%%(%x%x)", function(digits)
    return string.char(tonumber(digits, 16))
  end))
end

--- The path and the fields of the query; nil for a target in an unusual form.
local function parse(target)
  local path, query = target:match "^(/[%w/._,%-]*)%??(.*)$"
  if not path or path:find("..", 1, true) or path:find "//" then return nil end
  if #path ~= #target and target:sub(#path + 1, #path + 1) ~= "?" then return nil end
  local fields = {}
  for pair in query:gmatch "[^&]+" do
    local name, value = pair:match "^([^=]*)=?(.*)$"
    fields[decode(name)] = decode(value)
  end
  return path, fields
end

--- The path and the fields of a request that may be answered; otherwise nil, the status and a
--- sentence.
function guard:admit(request)
  if not self.hosts[(request.host or ""):lower()] then
    return nil, 403, "this server answers to 127.0.0.1 alone"
  end
  if request.origin and not self.origins[request.origin:lower()] then
    return nil, 403, "the request comes from another page"
  end
  if request.method ~= "GET" and request.method ~= "POST" then
    return nil, 405, "only GET and POST are answered"
  end
  local path, fields = parse(request.target)
  local is_program = path == "/here" and self:is_token(fields.token)
  if request.method == "POST" and not request.origin and not is_program then
    return nil, 403, "a POST needs an Origin"
  end
  if not path then return nil, 404, "there is no such address" end
  local is_foreign = request.site and request.site ~= "same-origin" and request.site ~= "none"
  if self.public[path] and not is_foreign or self:is_token(fields.token)
    or self:is_token(request.token) then
    return path, fields
  end
  if path == "/" then return "/again.html", fields end
  return nil, 403, "the token is missing: use the address that celspan watch has printed"
end

return guard
