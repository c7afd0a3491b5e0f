target_sources(copeel_csg PRIVATE )
