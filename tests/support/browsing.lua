--- Pages in a browser, which is begun once for all tests of a file: see browser.js.
local json = require "celspan.json"
local system = require "tests.support.system"

local browsing = {}

local folder, answers, requests -- of the browser that runs

-- The requests are closed first, when the interpreter ends, and then the browser ends.
local function begin()
  folder = os.tmpname()
  os.remove(folder)
  assert(os.execute(("mkdir '%s' && mkfifo '%s/requests'"):format(folder, folder)))
  answers = assert(io.popen(("node tests/support/browser.js '%s/chromium' <'%s/requests' 2>&1; "
    .. "rm -rf '%s'"):format(folder, folder, folder)))
  requests = assert(io.open(folder .. "/requests", "w"))
end

--- Ends a browser that failed, and returns what it said.
local function finish(first)
  local rest = answers:read "a"
  requests:close()
  answers:close()
  answers = nil
  return (first or "") .. "\n" .. rest
end

--- What the steps return, in JavaScript, on the page of an address. seconds: for all, or nil.
function browsing.see(address, steps, seconds)
  if not answers then begin() end
  system.write(folder .. "/steps.js", steps)
  requests:write(("%s %s/steps.js %s\n"):format(address, folder, seconds or ""))
  requests:flush()
  local answer = answers:read "l"
  local said = answer and json.decode(answer)
  if said == nil then error(finish(answer), 2) end
  return said
end

return browsing
