message(STATUS "install: later")
