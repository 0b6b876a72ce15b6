# muscle
