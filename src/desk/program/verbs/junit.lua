--- The results of `celspan test --junit FILE`, in the XML that CI servers read: a suite for each
--- spec file, and a case for each test.
--
-- Source: the schema of JUnit reports that Jenkins and GitLab accept.
local program = ...

local junit = {}

--- A text without the control characters that XML 1.0 cannot have.
local function content(text)
  return program.markup(program.utf8(text):gsub("[%z\1-\8\11-\31\127]", " "))
end

--- An attribute: the first line of a text.
local function attribute(name, text)
  return (' %s="%s"'):format(name, content(text:match "^[^\n]*"))
end

local function case_of(run, test)
  local name = ("    <testcase%s%s time=\"%.3f\""):format(attribute("classname", run.path),
    attribute("name", test.name), test.seconds)
  if test.kind == "pass" then return name .. "/>\n" end
  local tag = test.kind == "fail" and "failure" or "skipped"
  return ("%s><%s%s>%s</%s></testcase>\n"):format(name, tag, attribute("message", test.message),
    content(test.message), tag)
end

local function suite_of(run)
  local cases, seconds = {}, 0
  for i, test in ipairs(run.tests) do
    cases[i], seconds = case_of(run, test), seconds + test.seconds
  end
  return ('  <testsuite%s tests="%d" failures="%d" skipped="%d" time="%.3f">\n%s  </testsuite>\n')
    :format(attribute("name", run.path), #run.tests, run.failed, run.skipped, seconds,
      table.concat(cases))
end

--- The report of the first `count` spec files.
function junit.report(runs, count)
  local suites = {}
  for i = 1, count do suites[i] = suite_of(runs[i]) end
  return '<?xml version="1.0" encoding="UTF-8"?>\n<testsuites>\n' .. table.concat(suites)
    .. "</testsuites>\n"
end

return junit
