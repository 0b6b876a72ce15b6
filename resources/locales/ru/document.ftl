# Открытие файлов.
message-verbatim = { $words }
document-not-found = Такого файла нет.
document-permission = Нет права на чтение этого файла.
document-folder = Это папка, а не файл.
document-not-regular = Это не обычный файл.
document-empty = Файл пуст.
document-io = Не удалось прочитать файл: { $reason }.
document-too-large = Файл больше предела в { NUMBER($limit, useGrouping: 0) } МиБ.
document-not-text = Это не текст в UTF-8, а мышца описывается в файле YAML.
document-foreign = Sinew не читает { $format }; он читает COLLADA (.dae, .zae) и мышцы (.yaml).
document-table = Это таблица, из неё нельзя построить сцену. Измеренные радиусы читают sinew fit и sinew measure --compare.
document-session = Это файл сеанса; его открывают окно, sinew info и sinew render.
document-unknown = Sinew не знает этого формата файла; он читает COLLADA (.dae, .zae) и мышцы (.yaml).
document-cancelled = Загрузка отменена.
document-standard-input = стандартный ввод
document-built-in = встроенный бицепс
document-image-missing = Изображение «{ $uri }»{ $count ->
        [1] {""}
        [one] , на которое ссылается { NUMBER($count, useGrouping: 0) } элемент <image>,
        [few] , на которое ссылаются { NUMBER($count, useGrouping: 0) } элемента <image>,
       *[other] , на которое ссылаются { NUMBER($count, useGrouping: 0) } элементов <image>,
    } не найдено; поверхность рисуется сплошным цветом.
document-image-broken = Изображение «{ $uri }»{ $count ->
        [1] {""}
        [one] , на которое ссылается { NUMBER($count, useGrouping: 0) } элемент <image>,
        [few] , на которое ссылаются { NUMBER($count, useGrouping: 0) } элемента <image>,
       *[other] , на которое ссылаются { NUMBER($count, useGrouping: 0) } элементов <image>,
    } не удалось декодировать ({ $reason }); поверхность рисуется сплошным цветом.
document-image-reduced = { $count ->
        [1] Изображение «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей уменьшено до { NUMBER($columns, useGrouping: 0) } × { NUMBER($rows, useGrouping: 0) }
        [one] { NUMBER($count, useGrouping: 0) } изображение уменьшено, первое из них – «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей – до { NUMBER($columns, useGrouping: 0) } × { NUMBER($rows, useGrouping: 0) }
        [few] { NUMBER($count, useGrouping: 0) } изображения уменьшены, первое из них – «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей – до { NUMBER($columns, useGrouping: 0) } × { NUMBER($rows, useGrouping: 0) }
       *[other] { NUMBER($count, useGrouping: 0) } изображений уменьшены, первое из них – «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей – до { NUMBER($columns, useGrouping: 0) } × { NUMBER($rows, useGrouping: 0) }
    }: предел для всех изображений документа вместе – { NUMBER($limit, useGrouping: 0) } МБ.
document-image-no-room = { $count ->
        [1] Изображение «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей не учтено
        [one] { NUMBER($count, useGrouping: 0) } изображение не учтено, первое из них – «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей
        [few] { NUMBER($count, useGrouping: 0) } изображения не учтены, первое из них – «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей
       *[other] { NUMBER($count, useGrouping: 0) } изображений не учтены, первое из них – «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей
    }: предел для всех изображений документа вместе – { NUMBER($limit, useGrouping: 0) } МБ.
document-image-decoding = Изображение «{ $uri }» в { NUMBER($width, useGrouping: 0) } × { NUMBER($height, useGrouping: 0) } пикселей не учтено: декодирование заняло бы больше { NUMBER($limit, useGrouping: 0) } МБ памяти.
document-image-memory = На { $count ->
        [1] изображение «{ $uri }»
        [one] { NUMBER($count, useGrouping: 0) } изображение, первое из них – «{ $uri }»,
        [few] { NUMBER($count, useGrouping: 0) } изображения, первое из них – «{ $uri }»,
       *[other] { NUMBER($count, useGrouping: 0) } изображений, первое из них – «{ $uri }»,
    } не хватает памяти; вместо { $count ->
        [1] него
       *[other] них
    } рисуется сплошной цвет.
document-image-side = по одной стороне больше { NUMBER($limit, useGrouping: 0) } пикселей
document-image-no-pixels = не хватает пикселей
document-image-colours = такой вид цветов неизвестен
document-clip-not-opened = Клип, названный в файле мышц, не удалось открыть ({ $error }); проверьте ключ «clip» в файле мышц.
document-new-muscles = новые мышцы
document-new-muscles-number = новые мышцы { $number }

# Что говорит система, когда отказывает: конец предложения о том, чего не удалось сделать.
io-not-found = такого файла или папки нет
io-no-folder = такой папки нет
io-denied = на это нет прав
io-no-writing = нет права писать в эту папку
io-not-a-folder = часть пути – не папка
io-a-folder = это папка
io-read-only = файловая система только для чтения
io-full = на диске нет места
io-quota = дисковая квота исчерпана
io-memory = на это не хватает памяти
io-name = файловая система не допускает такого имени
io-too-large = файловая система не допускает файлов такого размера
io-too-many-open = открыто слишком много файлов
io-link-loop = символические ссылки образуют цикл
io-busy = файл занят другой программой
io-there-already = такое имя уже занято
io-device = устройство работает с ошибками
io-gone = программа-получатель больше не читает
io-cut-short = данные обрываются слишком рано
io-not-supported = система здесь этого не поддерживает
io-slow = время ожидания ответа истекло

document-yaml-several-documents = Здесь начинается второй документ YAML, а в файле может быть один. Уберите это «---» и всё, что после него, или сохраните отдельным файлом.
document-yaml-too-many-values = В файле больше { NUMBER($limit, useGrouping: 0) } значений (псевдонимы раскрываются).
document-yaml-too-much-text = Тексты файла занимают больше { NUMBER($limit, useGrouping: 0) } МиБ (псевдонимы раскрываются).
document-yaml-too-deep = Значения вложены здесь глубже { $limit } уровней; ни одному файлу не нужно больше десяти.
document-yaml-alias-in-itself = Этот псевдоним ссылается на значение, внутри которого он стоит.
document-yaml-syntax = Это неправильный YAML: { $reason }.
document-yaml-unfitting = Здесь { $found }, а такое значение здесь недопустимо.
document-yaml-found-nothing = пусто
document-yaml-found-bool = true или false
document-yaml-found-number = число
document-yaml-found-text = текст
document-yaml-found-list = список
document-yaml-found-map = группа ключей
document-yaml-found-tag = значение с тегом
document-yaml-wrong-count = Здесь значений: { $count }, а нужно другое количество.
document-yaml-unknown-word = Слово «{ $word }» здесь неизвестно; известны: { $known }.
document-yaml-missing-key = Здесь не указан ключ «{ $key }».
document-yaml-repeated-key = Ключ «{ $key }» указан здесь второй раз; уберите один из двух.
document-yaml-reason-bracket = закрыта скобка, которую не открывали
document-yaml-reason-escape = неизвестный управляющий код с «\» в тексте в кавычках
document-yaml-reason-anchor = псевдоним «*» ссылается на якорь «&», которого раньше не было
document-yaml-reason-anchor-here = якорь «&» или псевдоним «*» здесь недопустим
document-yaml-reason-indentation = здесь неверный отступ
document-yaml-reason-directive = директива «%» здесь недопустима
document-yaml-reason-tag = неверный тег «!»
document-yaml-reason-after = после конца документа есть текст
document-yaml-reason-colon = двоеточие здесь недопустимо; часто дело в отступе
document-yaml-reason-no-colon = после ключа нет двоеточия
document-yaml-reason-key = здесь ожидался ключ; часто дело в отступе
document-yaml-reason-list = список в «[ ]» не закрыт или не хватает запятой
document-yaml-reason-map = отображение в «{"{"} {"}"}» не закрыто или не хватает запятой
document-yaml-reason-dash = здесь ожидался «-»; часто дело в отступе
document-yaml-reason-dash-here = список не может начинаться здесь с «-»
document-yaml-reason-character = этот символ здесь недопустим; табуляция – не отступ
document-yaml-reason-end = файл заканчивается внутри текста в кавычках
document-yaml-reason-control = невидимый управляющий символ
document-yaml-reason-content = здесь ожидалось значение
document-too-many-files = В сеансе файлов: { $count }; предел – { $limit }.
document-too-much-surface = С этим файлом у поверхностей всех мышц было бы больше { NUMBER($limit, useGrouping: 0) } вершин, а это предел отрисовки.
document-unnamed-animation = Анимация
document-unnamed-scene = Сцена
document-unnamed-clip = Клип { $number }
document-unnamed-node = Узел { $number }
document-unnamed-mesh = Полигональная сетка
document-unnamed-skin = Скин
document-unnamed-morph = Морфинг
document-unnamed-material = Материал
document-unnamed-image = Изображение
document-unnamed-light = Свет
document-unnamed-camera = Камера
document-muscle-outside-skin = Мышца лежит вне кожи, которую двигают её кости, поэтому кожа за ней не следует.
