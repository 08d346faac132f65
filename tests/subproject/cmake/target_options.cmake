message(FATAL_ERROR "this module is the parent's own")
