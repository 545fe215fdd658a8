--- celspan watch at work in a folder, for its specs:
---
---   local watching = require "tests.support.watching"
---   before_each(function() watching.begin { ["shot.lua"] = FILM } end)
---   after_each(watching.finish)
---   local said = watching.see(watching.watch(), [=[ return page.get("document.title"); ]=])
local browsing = require "tests.support.browsing"
local json = require "celspan.json"
local workbench = require "tests.support.workbench"

local watching = {}

--- Code that precedes the steps in the page.
local HELP = [[
  const canvas = name => `document.querySelector("#canvas").dataset.${name}`;
  const text = id => page.get(`document.querySelector("#${id}").textContent`);
]]

local server

--- files: texts by name. The folder is watching.bench.
function watching.begin(files)
  watching.bench = workbench.new()
  for name, content in pairs(files) do watching.bench:write(name, content) end
end

--- Starts `command`, which prints the number of its process, and waits until `said` finds something
--- in its output.
function watching.start(command, said)
  local _, out = watching.bench:inside(command .. " & echo $!")
  server = out:match "%d+"
  for _ = 1, 600 do
    local address = said()
    if address then return address end
    os.execute "sleep 0.05"
  end
  error("no server: " .. (watching.bench:read "complained" or ""))
end

--- Starts the server in the folder. Returns its address.
function watching.watch(arguments)
  local bench = watching.bench
  return watching.start(("exec '%s' watch %s >said 2>complained")
    :format(workbench.absolute, arguments or "shot.lua"), function()
    return (bench:read "said" or ""):match "^watching (%g+)\n"
  end)
end

--- The number of the server's process.
function watching.server() return server end

function watching.stop()
  if not server then return end
  os.execute(("kill %s 2>/dev/null; while kill -0 %s 2>/dev/null; do sleep 0.02; done")
    :format(server, server))
  server = nil
end

function watching.finish()
  watching.stop()
  watching.bench:remove()
end

--- The result of the steps, in JavaScript, for a program that speaks to the server: stranger.js.
function watching.speak(address, steps)
  local path = watching.bench:write("steps.js", steps)
  local code, out, err = watching.bench:shell(("node tests/support/stranger.js '%s' '%s'")
    :format(address, path))
  assert(code == 0, err)
  return assert(json.decode(out))
end

--- The result of the steps in a browser: see browser.js. seconds: for all steps, or nil.
function watching.see(address, steps, seconds)
  return browsing.see(address, HELP .. steps, seconds)
end

return watching
