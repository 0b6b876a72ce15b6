# Открытие файлов.
document-not-found = Такого файла нет.
document-permission = Нет права на чтение этого файла.
document-folder = Это папка, а не файл.
document-not-regular = Это не обычный файл.
document-empty = Файл пуст.
document-io = Не удалось прочитать файл: { $reason }
document-too-large = Файл больше предела в { NUMBER($limit, useGrouping: 0) } МиБ.
document-not-text = Это не текст в UTF-8, а мышца описывается в файле YAML.
document-cancelled = Загрузка отменена.
document-standard-input = стандартный ввод
document-built-in = встроенный бицепс
document-image-missing = Изображение «{ $uri }» не найдено; вместо него рисуется сплошной цвет.
document-image-broken = Изображение «{ $uri }» не удалось прочитать ({ $reason }); вместо него рисуется сплошной цвет.
document-clip-not-opened = Не удалось открыть клип, для которого сделаны мышцы ({ $error }); проверьте «clip» в файле мышц.
document-new-muscles = новые мышцы
document-new-muscles-number = новые мышцы { $number }
