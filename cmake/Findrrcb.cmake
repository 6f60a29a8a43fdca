# Examples are projects of their own that find the installed library; built with the library, they
# find its targets.
set(rrcb_FOUND TRUE)
