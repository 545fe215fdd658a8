--- Whether the last measurement met the targets of tests/bench/targets/list.lua. From the top of
--- the tree:
---
---   lua5.4 tests/bench/targets/check.lua FOLDER
---
--- FOLDER holds bench.csv, which tests/bench/main.lua wrote. Prints each target that was missed and
--- how many were met; the exit code is 1 if one was missed, 2 if none was measured.
package.path = "./?.lua;" .. package.path
local results = require "tests.bench.results"
local targets = require "tests.bench.targets.list"

local folder = assert(..., "usage: check.lua FOLDER")
local met, missed, unknown = 0, 0, 0
for _, line in ipairs(targets.lines(results.read(folder .. "/bench.csv"))) do
  if line.is_met then
    met = met + 1
  elseif line.is_met == nil then
    unknown = unknown + 1
  else
    missed = missed + 1
    print(("missed: %s: %s"):format(line.what, line.text))
  end
end
print(("%d targets met, %d missed, %d not measured"):format(met, missed, unknown))
os.exit(missed > 0 and 1 or met == 0 and 2 or 0)
