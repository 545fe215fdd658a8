-- Mutants that change no picture, and why: they are not run. Each is the file's list of
-- { the line as it stands, the change as ./run mutate tells it, the reason }.
return {}
