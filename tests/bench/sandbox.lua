-- The cost of the sandbox of scripts, compared with --trust: instructions of ten frames of the demo
-- film, at 1920 x 1080 on one thread, as counted by valgrind's callgrind, so that the load of the
-- machine does not matter.
--
--   lua5.4 tests/bench/sandbox.lua build/celspan
local celspan = arg[1] or "build/celspan"

--- The instructions of a run, of all its threads.
local function count(options)
  local run =
    assert(io.popen(("valgrind --tool=callgrind --callgrind-out-file=/dev/null '%s' render "
    .. "scripts/demo.lua "
    .. "--frames 1-240:24 --size 1920x1080 --workers 1 --hash --progress none %s 2>&1")
    :format(celspan, options)))
  local words = run:read "a"
  assert(run:close(), words)
  return tonumber(words:match "Collected : (%d+)")
end

local trusted, safe = count "--trust", count ""
print(("--trust %d  in the sandbox %d  %+.2f %%"):format(trusted, safe, 100 * (safe / trusted - 1)))
