set(SWITCHYARD_SANITIZE "" CACHE STRING "Sanitizers, as -fsanitize takes them")
if(SWITCHYARD_SANITIZE)
  add_compile_options(-fsanitize=${SWITCHYARD_SANITIZE} -fno-sanitize-recover=all
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SWITCHYARD_SANITIZE})
endif()
